/* SPDX-License-Identifier: Apache-2.0 */
/* Whose frames a line accepts: those of the agent, unless a component replaces this header. Internal. */
#ifndef MICROROS_XRCE_FRAMING_ADDRESSES_H
#define MICROROS_XRCE_FRAMING_ADDRESSES_H

#include <stdbool.h>
#include <stdint.h>

/* Returns whether byte `at` of a frame is its address: the agent's (0) as the source, then the client's (1). */
static inline bool xrce_framing_is_address(uint32_t at, uint8_t byte)
{
  return byte == at;
}

#endif /* MICROROS_XRCE_FRAMING_ADDRESSES_H */
