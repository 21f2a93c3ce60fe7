/* SPDX-License-Identifier: Apache-2.0 */
/* How much of a byte stream is received at once, with the lock of the library. A component with a task for the session replaces
 * this header. Internal. */
#ifndef MICROROS_XRCE_TURN_BYTES_H
#define MICROROS_XRCE_TURN_BYTES_H

/* Bytes of a line, so that a flooded one cannot block the client. */
enum { XRCE_TURN_BYTES = 2048 };

/* Reads of a connection for one message: until nothing more has arrived. */
enum { XRCE_TURN_READS = 65535 };

/* What xrce_transport_receive returns where it stopped before it had read all that has arrived: as if it had. */
enum { XRCE_TURN_PARTIAL = 0 };

#endif /* MICROROS_XRCE_TURN_BYTES_H */
