/* SPDX-License-Identifier: Apache-2.0 */
/* Requests of other boards that reach a service without the agent. Called with the lock held, but for
 * rmw_peer_abandon. Internal. */
#ifndef MICROROS_RMW_PEER_SERVICE_H
#define MICROROS_RMW_PEER_SERVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the oldest request is one of another board; *has_room: whether it can be answered now. */
bool rmw_peer_has_room(const xrce_endpoint_t * service, bool * has_room);

/* Returns whether an identity is that of a request of another board. */
bool rmw_peer_is_request(const rmw_request_id_t * request);

/* Keeps room for the reply to such a request. Returns false, having done nothing, for another one. */
bool rmw_peer_keep_room(const rmw_request_id_t * request);

/* Gives that room back; the same. */
bool rmw_peer_free_room(const rmw_request_id_t * request);

/* Same, without the lock. */
bool rmw_peer_abandon(const rmw_request_id_t * request);

/*
 * Sends the reply, of type `sent`, to such a request, whose identity is that of the wire (XRCE_IDENTITY_SIZE bytes).
 * The reply to a board that has restarted meanwhile is dropped and counted. RMW_RET_ERROR, with a text: it is above its
 * limits, or the link has no room. */
rmw_ret_t rmw_peer_respond(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const uint8_t * identity,
  const void * ros_response);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PEER_SERVICE_H */
