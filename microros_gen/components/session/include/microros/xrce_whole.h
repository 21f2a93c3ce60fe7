/* SPDX-License-Identifier: Apache-2.0 */
/* Whether a message is complete, for everything that receives messages. Internal. */
#ifndef MICROROS_XRCE_WHOLE_H
#define MICROROS_XRCE_WHOLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_wire.h"

/*
 * Returns whether the submessages fill the message: a partial one counts as lost, and the sender repeats it. A length
 * is compared before it is added: on a 16-bit processor the sum would wrap, and the loop would not end. */
static inline bool xrce_is_whole(const uint8_t * message, size_t size)
{
  size_t at = XRCE_MESSAGE_HEADER;

  /* A message comes from the agent or from a link: the sum is above the larger of both. */
  /* at most (MICROROS_INPUT_SIZE + MICROROS_PEER_LARGEST) / 4 or MICROROS_INPUT_SIZE / 4 rounds */
  while (at + XRCE_SUBMESSAGE_HEADER <= size) {
    const size_t length = xrce_get_le16(&message[at + 2u]);

    if (length > size - at - XRCE_SUBMESSAGE_HEADER) {
      return false;
    }
    at = (at + XRCE_SUBMESSAGE_HEADER + length + 3u) & ~(size_t)3u;
  }
  return at > XRCE_MESSAGE_HEADER && size <= at;
}

#endif /* MICROROS_XRCE_WHOLE_H */
