/* SPDX-License-Identifier: Apache-2.0 */
/* Room for a message of the session itself: the one buffer of the stream. Internal. */
#ifndef MICROROS_XRCE_STREAM_BEST_EFFORT_SPARE_H
#define MICROROS_XRCE_STREAM_BEST_EFFORT_SPARE_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_stream_best_effort.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns room for MICROROS_BEST_EFFORT_SIZE - XRCE_MESSAGE_HEADER bytes of submessages; never NULL. */
static inline uint8_t * xrce_stream_best_effort_spare(void)
{
  return xrce_stream_best_effort_reserve();
}

/* Sends `size` bytes from there at once. */
static inline void xrce_stream_best_effort_send_spare(xrce_session_t * session, size_t size)
{
  (void)xrce_stream_best_effort_commit(session, size); /* a lost message is repeated */
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_BEST_EFFORT_SPARE_H */
