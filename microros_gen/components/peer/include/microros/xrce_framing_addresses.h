/* SPDX-License-Identifier: Apache-2.0 */
/* Whose frames a line accepts: those of an agent and of a board that sends as a client. Internal. */
#ifndef MICROROS_XRCE_FRAMING_ADDRESSES_H
#define MICROROS_XRCE_FRAMING_ADDRESSES_H

#include <stdbool.h>
#include <stdint.h>

/* Returns whether byte `at` of a frame is an address of the agent (0) or of a client (1). */
static inline bool xrce_framing_is_address(uint32_t at, uint8_t byte)
{
  (void)at;
  return byte <= 1u;
}

#endif /* MICROROS_XRCE_FRAMING_ADDRESSES_H */
