/* SPDX-License-Identifier: Apache-2.0 */
/* How much of a byte stream is received at once, with the lock of the library. Replaces the header of component `session`.
 * Internal. */
#ifndef MICROROS_XRCE_TURN_BYTES_H
#define MICROROS_XRCE_TURN_BYTES_H

/* Bytes of a line. The task of the session releases the lock after so many, and takes it again for the next ones. */
enum { XRCE_TURN_BYTES = 64 };

/* Reads of a connection for one message. The same applies. */
enum { XRCE_TURN_READS = 1 };

/* What xrce_transport_receive returns where it stopped before it had read all that has arrived. */
enum { XRCE_TURN_PARTIAL = -2 };

#endif /* MICROROS_XRCE_TURN_BYTES_H */
