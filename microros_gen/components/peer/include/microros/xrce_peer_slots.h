/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reliable messages of a link that wait until they are acknowledged, each in a slot. The numbers of a session are given
 * to the messages in their order: one to each, or one to each fragment of a message that is larger than the MTU of the
 * link (OMG DDS-XRCE 1.0, 8.3.5.14). At most XRCE_PEER_WINDOW numbers are in use. Internal. */
#ifndef MICROROS_XRCE_PEER_SLOTS_H
#define MICROROS_XRCE_PEER_SLOTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_peer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An ACKNACK has this many bits. */
enum { XRCE_PEER_WINDOW = 16 };

/* Returns the largest submessage that fits a slot and that the other board of the link takes, in bytes. */
size_t xrce_peer_slots_capacity(uint8_t index);

/* Returns room for a submessage of this size in the next free slot. Not for a link whose slots are all in use. */
uint8_t * xrce_peer_slots_room(const xrce_peer_t * peer, uint8_t index);

/* Takes `size` bytes in that room as the newest message. */
void xrce_peer_slots_put(xrce_peer_t * peer, uint8_t index, size_t size);

/* Returns how many numbers from peer->first on are in use. */
uint8_t xrce_peer_slots_window(const xrce_peer_t * peer, uint8_t index);

/* Sends the message, or fragment of one, with the number peer->first + `place`. Returns false if the line has no room. */
bool xrce_peer_slots_send(xrce_client_t * client, uint8_t index, uint8_t place);

/* The first `count` numbers in use are acknowledged: frees the slots of messages that are complete with them. */
void xrce_peer_slots_free(xrce_peer_t * peer, uint8_t index, uint8_t count);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_SLOTS_H */
