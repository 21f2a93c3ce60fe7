/* SPDX-License-Identifier: Apache-2.0 */
/* When the library looks for an interface, and what it knows of one from the messages that were sent. Internal. */
#ifndef MICROROS_XRCE_PEER_FIND_NOTE_H
#define MICROROS_XRCE_PEER_FIND_NOTE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Notes whether the network took a message. */
void xrce_peer_find_note(uint8_t index, bool is_sent);

/* Returns the time until an interface is looked for, at most `left`. */
uint32_t xrce_peer_find_left(uint8_t index, uint32_t left, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_FIND_NOTE_H */
