/* SPDX-License-Identifier: Apache-2.0 */
/* No client of this board calls another board. Internal. */
#ifndef MICROROS_XRCE_PEER_CALLING_H
#define MICROROS_XRCE_PEER_CALLING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"

/* Takes WRITE_DATA of a link, at byte `at` of the message at MICROROS_PEER_HEAD of a buffer, if it is a reply; otherwise
 * returns false. */
static inline bool xrce_peer_calling_take(
  xrce_client_t * client, uint8_t index, const uint8_t * input, size_t at, uint32_t now)
{
  (void)client;
  (void)index;
  (void)input;
  (void)at;
  (void)now;
  return false;
}

/* Called when the other board of a link has forgotten the own session: requests may get no reply. */
static inline void xrce_peer_calling_renew(xrce_client_t * client, uint8_t index)
{
  (void)client;
  (void)index;
}

#endif /* MICROROS_XRCE_PEER_CALLING_H */
