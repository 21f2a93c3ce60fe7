/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The messages of the session, sealed: each is in a record of a Noise session with the agent (docs/howto/seal.md has the
 * layouts). The caller holds the lock of the library. Replaces the header of `session`. Internal. */
#ifndef MICROROS_XRCE_MESSAGES_H
#define MICROROS_XRCE_MESSAGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

struct xrce_transport_t;

/* Bytes of either message of a handshake, and those of a record around its message. */
#define XRCE_SEAL_FIRST 60u
#define XRCE_SEAL_OVERHEAD 32u

/* An upper bound of XRCE_LARGEST_SENT, for comments that bound a loop or a copy: a sum, which the report on holds of the
 * lock can read. */
#define XRCE_SEALED_MOST (MICROROS_MTU + XRCE_SEAL_FIRST)

/* The agent has one session of a client: that of the handshake that was confirmed last. */
#define XRCE_MESSAGES_ONE_SOCKET true

/* --- implemented by the transport --- */

/* As xrce_transport_open, _close, _send and _receive, for records and messages of handshakes. */
bool xrce_plain_open(struct xrce_transport_t * transport);
void xrce_plain_close(struct xrce_transport_t * transport);
bool xrce_plain_send(struct xrce_transport_t * transport, const uint8_t * message, size_t size);
int32_t xrce_plain_receive(struct xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

/* --- called by the session --- */

/* Opens the transport and begins a handshake, whose first message the first call of send transmits. Without a key, or
 * if a function of microros/seal.h fails, it sets `fault` and returns false. */
bool xrce_transport_open(struct xrce_transport_t * transport);

/* Closes the transport and wipes all keys. */
void xrce_transport_close(struct xrce_transport_t * transport);

/*
 * Sends one message. Without a session it sends the first message of the handshake again, if that is due, and keeps
 * the latest message of up to XRCE_SEAL_WAITING bytes for the end of the handshake; it refuses larger ones. */
bool xrce_transport_send(struct xrce_transport_t * transport, const uint8_t * message, size_t size);

/* Receives one message. Returns its size, 0 if none has arrived or the handshake went on (more may be waiting), -1 for a
 * discarded one, XRCE_TURN_PARTIAL (xrce_turn_bytes.h) for a part of one. */
int32_t xrce_transport_receive(struct xrce_transport_t * transport, uint8_t * buffer, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_MESSAGES_H */
