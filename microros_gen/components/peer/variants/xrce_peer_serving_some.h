/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Services of this board for other boards. A request is WRITE_DATA on a requester; it waits in the queue of its service as
 * one of the agent does, after an identity that leads the reply back: instead of a GUID a mark, the link, and the session
 * of the other board. Internal. */
#ifndef MICROROS_XRCE_PEER_SERVING_H
#define MICROROS_XRCE_PEER_SERVING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_peer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The services of this board on links; from the plan. */
extern const xrce_peer_service_t xrce_peer_repliers[MICROROS_PEER_REPLIERS];

/* Takes WRITE_DATA of a link, at byte `at` of the message at MICROROS_PEER_HEAD of a buffer, if it is a request; otherwise
 * returns false. */
bool xrce_peer_serving_take(xrce_client_t * client, uint8_t index, uint8_t * input, size_t at, uint32_t now);

/* Called for a new session of the other board of a link. */
void xrce_peer_serving_begin(uint8_t index);

/* Returns how many reliable messages of a link are not acknowledged. */
uint32_t xrce_peer_serving_unacknowledged(const xrce_client_t * client, uint8_t index);

/* Returns whether the free slots of a link are kept for replies. */
bool xrce_peer_serving_keeps_all(const xrce_client_t * client, uint8_t index);

/* Keeps a slot of a link for a reply, or gives one back. */
void xrce_peer_serving_keep(uint8_t index);
void xrce_peer_serving_free(uint8_t index);

/* Returns the link of a request whose GUID this is; MICROROS_PEERS: it came from no other board. */
uint8_t xrce_peer_serving_link(const uint8_t * guid);

/* Returns whether the board that has sent such a request still waits for the reply. */
bool xrce_peer_serving_is_current(const xrce_client_t * client, uint8_t index, const uint8_t * guid);

/* Returns the replier of a service on a link, by its index among the services of the image; XRCE_PEER_NO_OBJECT: none. */
uint16_t xrce_peer_serving_object(uint8_t index, uint16_t service);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_SERVING_H */
