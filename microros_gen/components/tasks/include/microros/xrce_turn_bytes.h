/* SPDX-License-Identifier: Apache-2.0 */
/* How much of a byte stream is received at once, with the lock of the library. Replaces the header of component `session`.
 * Internal. */
#ifndef MICROROS_XRCE_TURN_BYTES_H
#define MICROROS_XRCE_TURN_BYTES_H

#include <stdbool.h>
#include <stdint.h>

/* Bytes of a line. The task of the session releases the lock after so many, and takes it again for the next ones. */
enum { XRCE_TURN_BYTES = 64 };

/* Reads of a connection for one message. The same applies. */
#define XRCE_TURN_READS 1u

/* What xrce_transport_receive returns where it stopped before it had read all that has arrived. */
enum { XRCE_TURN_PARTIAL = -2 };

/* Returns whether there may be more than what it has read, although it returns no message. */
static inline bool xrce_turn_is_partial(int32_t size)
{
  return size == (int32_t)XRCE_TURN_PARTIAL;
}

/* Returns whether it stops after each read of a connection. */
static inline bool xrce_turn_ends_with_read(void)
{
  return true;
}

#endif /* MICROROS_XRCE_TURN_BYTES_H */
