/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lines for /rosout that wait for a session and for room in the reliable stream. The oldest go first; at most half of the
 * stream's slots have lines, so that these do not displace what the application sends. Under the lock of the session.
 * Internal.
 */
#ifndef MICROROS_XRCE_ROSOUT_H
#define MICROROS_XRCE_ROSOUT_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sets the data writer of /rosout; NULL: none is open, and lines wait. */
void xrce_rosout_use(const xrce_endpoint_t * writer);

/* Returns whether the data writer is open in this client's session. */
bool xrce_rosout_is_open(const xrce_client_t * client);

/* Returns the client whose session the data writer is open in; NULL: none is open. */
const xrce_client_t * xrce_rosout_client(void);

/* Keeps a line, an encoded rcl_interfaces/msg/Log. Returns false without room for it: nothing has changed. */
bool xrce_rosout_put(const uint8_t * body, uint32_t size);

/* Returns whether two lines of `size` bytes have room, or none waits. */
bool xrce_rosout_has_room(uint32_t size);

/* Moves lines to the stream, as far as it has room for them. */
void xrce_rosout_send(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ROSOUT_H */
