/* SPDX-License-Identifier: Apache-2.0 */
/* No service of this board is for other boards. Internal. */
#ifndef MICROROS_XRCE_PEER_SERVING_H
#define MICROROS_XRCE_PEER_SERVING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros_config.h"

/* Takes WRITE_DATA of a link, at byte `at` of the message at MICROROS_PEER_HEAD of a buffer, if it is a request; otherwise
 * returns false. */
static inline bool xrce_peer_serving_take(
  xrce_client_t * client, uint8_t index, const uint8_t * input, size_t at, uint32_t now)
{
  (void)client;
  (void)index;
  (void)input;
  (void)at;
  (void)now;
  return false;
}

/* Called for a new session of the other board of a link. */
static inline void xrce_peer_serving_begin(uint8_t index)
{
  (void)index;
}

/* Returns how many reliable messages of a link are not acknowledged, which has no room for a further one. */
static inline uint32_t xrce_peer_serving_unacknowledged(const xrce_client_t * client, uint8_t index)
{
  (void)client;
  (void)index;
  return MICROROS_PEER_SLOTS;
}

/* Returns whether the free slots of a link are kept for replies. */
static inline bool xrce_peer_serving_keeps_all(const xrce_client_t * client, uint8_t index)
{
  (void)client;
  (void)index;
  return false;
}

#endif /* MICROROS_XRCE_PEER_SERVING_H */
