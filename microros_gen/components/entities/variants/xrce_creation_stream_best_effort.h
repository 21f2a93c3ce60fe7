/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Variant for creation: best_effort. Each repetition is a separate message; the agent reports that the object already
 * exists. Internal. */
#ifndef MICROROS_XRCE_CREATION_STREAM_H
#define MICROROS_XRCE_CREATION_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_client.h"
#include "microros/xrce_stream_best_effort_spare.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether a new request can be sent now. */
static inline bool xrce_creation_begin(xrce_client_t * client, uint32_t now)
{
  (void)client;
  (void)now;
  return true;
}

/* Returns the buffer for the one submessage of a request. */
static inline uint8_t * xrce_creation_room(xrce_client_t * client)
{
  (void)client;
  return xrce_stream_best_effort_spare();
}

/* Sends the first `size` bytes of the buffer. */
static inline void xrce_creation_send(xrce_client_t * client, size_t size)
{
  xrce_stream_best_effort_send_spare(&client->session, size);
}

/* Called when the STATUS of the request arrived. */
static inline void xrce_creation_end(xrce_client_t * client)
{
  (void)client;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CREATION_STREAM_H */
