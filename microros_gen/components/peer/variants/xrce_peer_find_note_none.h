/* SPDX-License-Identifier: Apache-2.0 */
/* Links whose device the library does not look for: it cannot disappear, or the port looks for it. Internal. */
#ifndef MICROROS_XRCE_PEER_FIND_NOTE_H
#define MICROROS_XRCE_PEER_FIND_NOTE_H

#include <stdbool.h>
#include <stdint.h>

/* Notes whether the network took a message. */
static inline void xrce_peer_find_note(uint8_t index, bool is_sent)
{
  (void)index;
  (void)is_sent;
}

/* Returns the time until a device is looked for, at most `left`: the library looks for none. */
static inline uint32_t xrce_peer_find_left(uint8_t index, uint32_t left, uint32_t now)
{
  (void)index;
  (void)now;
  return left;
}

#endif /* MICROROS_XRCE_PEER_FIND_NOTE_H */
