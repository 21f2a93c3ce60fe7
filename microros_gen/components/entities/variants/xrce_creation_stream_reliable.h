/* SPDX-License-Identifier: Apache-2.0 */
/* Variant for creation: reliable: the stream of the requests, in xrce_creation_*.c. Internal. */
#ifndef MICROROS_XRCE_CREATION_STREAM_H
#define MICROROS_XRCE_CREATION_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether a new request can be sent now; if not, nothing changes. */
bool xrce_creation_begin(xrce_client_t * client, uint32_t now);

/* Returns the buffer for the one submessage of a request. */
uint8_t * xrce_creation_room(xrce_client_t * client);

/*
 * Sends the first `size` bytes of the buffer. Until STATUS arrives, the request is repeated with the same
 * bytes. */
void xrce_creation_send(xrce_client_t * client, size_t size);

/* Called when the STATUS of the request arrived. */
void xrce_creation_end(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CREATION_STREAM_H */
