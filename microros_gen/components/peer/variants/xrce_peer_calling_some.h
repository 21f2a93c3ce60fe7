/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Clients of this board that call other boards. A reply is WRITE_DATA on a replier, after the identity of its request; it
 * waits in the queue of its client as one of the agent does. Internal. */
#ifndef MICROROS_XRCE_PEER_CALLING_H
#define MICROROS_XRCE_PEER_CALLING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_peer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The clients of this board that call others; from the plan. */
extern const xrce_peer_service_t xrce_peer_requesters[MICROROS_PEER_REQUESTERS];

/* Takes WRITE_DATA of a link, at byte `at` of the message at MICROROS_PEER_HEAD of a buffer, if it is a reply; otherwise
 * returns false. */
bool xrce_peer_calling_take(xrce_client_t * client, uint8_t index, uint8_t * input, size_t at, uint32_t now);

/* Called when the other board of a link has forgotten the own session: requests may get no reply. */
void xrce_peer_calling_renew(xrce_client_t * client, uint8_t index);

/* Returns the route of a client, by its index among those of the image; NULL: it calls no other board. */
const xrce_peer_service_t * xrce_peer_calling_route(uint16_t requester);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_CALLING_H */
