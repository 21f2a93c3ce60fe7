/* SPDX-License-Identifier: Apache-2.0 */
/* How much of a byte stream is received at once, with the lock of the library. A component with a task for the session replaces
 * this header. Internal. */
#ifndef MICROROS_XRCE_TURN_BYTES_H
#define MICROROS_XRCE_TURN_BYTES_H

#include <stdbool.h>
#include <stdint.h>

/* Bytes of a line, so that a flooded one cannot block the client. */
enum { XRCE_TURN_BYTES = 2048 };

/* Reads of a connection for one message: until nothing more has arrived. */
#define XRCE_TURN_READS 65535u

/* What xrce_transport_receive returns where it stopped before it had read all that has arrived: as if it had. */
enum { XRCE_TURN_PARTIAL = 0 };

/* Returns whether there may be more than what it has read, although it returns no message. */
static inline bool xrce_turn_is_partial(int32_t size)
{
  (void)size;
  return false;
}

/* Returns whether it stops after each read of a connection. */
static inline bool xrce_turn_ends_with_read(void)
{
  return false;
}

#endif /* MICROROS_XRCE_TURN_BYTES_H */
