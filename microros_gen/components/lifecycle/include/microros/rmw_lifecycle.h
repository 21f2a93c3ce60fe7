/* SPDX-License-Identifier: Apache-2.0 */
/* The state of each node as the client stores it, and replies in fragments. Internal. */
#ifndef MICROROS_RMW_LIFECYCLE_H
#define MICROROS_RMW_LIFECYCLE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_parts.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Return and set the state of a node that is open, as its id; 0: none. It survives a sleep with the session. */
uint8_t rmw_lifecycle_state(const rmw_node_t * node);
void rmw_lifecycle_set_state(const rmw_node_t * node, uint8_t state);

/* Sets what writes the body of a reply in fragments. */
void rmw_lifecycle_use(const rmw_node_t * node, xrce_parts_body_t body);

/* Returns whether a reply in fragments is under way. */
bool rmw_lifecycle_is_replying(const rmw_node_t * node);

/* Returns whether an open publisher has a session and room in its stream. */
bool rmw_lifecycle_has_room(const rmw_publisher_t * publisher);

/* Lets a request that is too large for an open service reach it with its first bytes. */
void rmw_lifecycle_answer_large(const rmw_service_t * service, bool answers);

/* Begins a reply in fragments; the next one has to wait for its end. */
void rmw_lifecycle_reply(const rmw_service_t * service, const rmw_request_id_t * request);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LIFECYCLE_H */
