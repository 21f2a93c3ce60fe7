/* SPDX-License-Identifier: Apache-2.0 */
/* No other board sends messages in fragments. Internal. */
#ifndef MICROROS_XRCE_PEER_FRAGMENTS_H
#define MICROROS_XRCE_PEER_FRAGMENTS_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_peer.h"

/* Called for a new session of the other board of a link. */
static inline void xrce_peer_fragments_reset(uint8_t index)
{
  (void)index;
}

/* Returns a submessage, which is no fragment. */
static inline const uint8_t * xrce_peer_fragments_front(uint8_t index, const uint8_t * submessage)
{
  (void)index;
  return submessage;
}

/* Returns the buffer of a link, which has the next reliable message of `size` bytes at MICROROS_PEER_HEAD. */
static inline uint8_t * xrce_peer_fragments_join(xrce_client_t * client, uint8_t index, const size_t * size)
{
  (void)client;
  (void)size;
  return xrce_peer_input(index);
}

#endif /* MICROROS_XRCE_PEER_FRAGMENTS_H */
