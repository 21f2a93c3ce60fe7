/* SPDX-License-Identifier: Apache-2.0 */
/* Other boards that get a message without the agent. Called with the lock held. Internal. */
#ifndef MICROROS_RMW_PEER_PUBLISH_H
#define MICROROS_RMW_PEER_PUBLISH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether other boards get messages of this publisher. Needs no lock. */
bool rmw_peer_has_route(const xrce_endpoint_t * writer);

/*
 * Sends a message to each board that subscribes to it. Never blocks. Returns whether nothing is to be sent to the
 * agent. *result is set if the message was not sent to another board. */
bool rmw_peer_publish(const xrce_endpoint_t * writer, const void * message, rmw_ret_t * result);

/* Same for a CDR body, little endian. */
bool rmw_peer_publish_body(
  const xrce_endpoint_t * writer, const uint8_t * body, size_t size, rmw_ret_t * result);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_PEER_PUBLISH_H */
