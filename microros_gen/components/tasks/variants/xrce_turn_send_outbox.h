/* SPDX-License-Identifier: Apache-2.0 */
/* Variant for functions of the application, which may wait for their line: the task of the session calls the write function
 * without the lock. Until then messages wait in a buffer. Internal. */
#ifndef MICROROS_XRCE_TURN_SEND_H
#define MICROROS_XRCE_TURN_SEND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Puts a message into a buffer while the task of the session runs, otherwise hands it to the transport. Returns false if it
 * was not accepted. The caller holds the lock. */
bool xrce_turn_send(xrce_transport_t * transport, const uint8_t * message, size_t size);

/* Returns whether the transport has every message. The caller holds the lock. */
bool xrce_turn_is_sent(void);

/* Called before the transport is closed, with the lock, which it releases while a message is written. Returns the number of
 * best-effort messages that are dropped. */
uint32_t xrce_turn_close(void);

/* Writes the oldest message without the lock, and waits as long as the application's function does. Returns whether it was
 * written. Only the task of the session calls it. */
bool xrce_turn_write(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TURN_SEND_H */
