/* SPDX-License-Identifier: Apache-2.0 */
/* Messages of other boards that arrive in fragments (OMG DDS-XRCE 1.0, 8.3.5.14). Internal. */
#ifndef MICROROS_XRCE_PEER_FRAGMENTS_H
#define MICROROS_XRCE_PEER_FRAGMENTS_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_peer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a new session of the other board of a link: what has arrived of a message is dropped. */
void xrce_peer_fragments_reset(uint8_t index);

/* Returns the submessage itself; of the first fragment of a message, what that message begins with. Another fragment is
 * itself. */
const uint8_t * xrce_peer_fragments_front(uint8_t index, const uint8_t * submessage);

/*
 * Takes the next reliable message of a link, whose `*size` bytes are in its buffer. Returns a buffer with a message of
 * `*size` bytes at MICROROS_PEER_HEAD: this one or, if it is the last fragment, the message that it completes; it is
 * valid until the next call. Returns NULL while fragments of a message are missing, and if a message is too large or
 * malformed; that is counted. */
uint8_t * xrce_peer_fragments_join(xrce_client_t * client, uint8_t index, size_t * size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PEER_FRAGMENTS_H */
