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

#endif /* MICROROS_XRCE_PEER_FIND_H */
