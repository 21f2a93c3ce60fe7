/* SPDX-License-Identifier: Apache-2.0 */
/* Links whose device cannot disappear. Internal. */
#ifndef MICROROS_XRCE_PEER_FIND_H
#define MICROROS_XRCE_PEER_FIND_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_forward.h"

/* Returns whether the device of a link is gone: never. A handle may be any number, such as an address. */
static inline bool xrce_peer_find(const xrce_client_t * client, uint8_t index, uint32_t now)
{
  (void)client;
  (void)index;
  (void)now;
  return false;
}

/* Notes whether the network took a message. */
static inline void xrce_peer_find_note(uint8_t index, bool is_sent)
{
  (void)index;
  (void)is_sent;
}

/* Returns `left`: no device is looked for. */
static inline uint32_t xrce_peer_find_left(uint8_t index, uint32_t left, uint32_t now)
{
  (void)index;
  (void)now;
  return left;
}

#endif /* MICROROS_XRCE_PEER_FIND_H */
