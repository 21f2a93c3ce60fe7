/* SPDX-License-Identifier: Apache-2.0 */
/* Services between two images of the chip. Called with the lock held. Internal. */
#ifndef MICROROS_RMW_SHARED_CALL_H
#define MICROROS_RMW_SHARED_CALL_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rmw_local.h"
#include "microros/rmw_local_service.h"
#include "microros/rmw_local_shared.h"
#include "microros/rmw_shared.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the words of the identity in a slot: 0 for a topic. */
uint32_t rmw_shared_call_words(const rmw_shared_ring_t * ring);

/* Returns whether a message in a slot is for its endpoint: a reply to a client that was opened again is not. */
bool rmw_shared_call_is_wanted(const rmw_shared_ring_t * ring, const uint32_t * slot);

/* Stores the identity of a request or reply in its place of the queue. */
void rmw_shared_call_note(
  const rmw_shared_ring_t * ring, const uint32_t * slot, const rmw_local_queue_t * queue, uint8_t place);

/* Called when the application opens an endpoint. */
void rmw_shared_call_opened(const xrce_endpoint_t * endpoint);

/* Returns whether the server of a client that has a ring is open. */
bool rmw_shared_call_is_open(const xrce_endpoint_t * client);

/*
 * Encode a request or a response, of type `sent`, into the ring of an endpoint that has one. RMW_RET_ERROR, with a
 * text, as for a publisher that is reliable. If the other end is not open, the message is dropped. */
rmw_ret_t rmw_shared_call_request(
  const xrce_endpoint_t * client, const microros_message_type_t * sent, const rmw_local_number_t * number,
  const void * message);
rmw_ret_t rmw_shared_call_reply(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const rmw_local_origin_t * origin,
  const void * message);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_SHARED_CALL_H */
