/* SPDX-License-Identifier: Apache-2.0 */
/* Room for a message of the session itself: a place beyond the queue. Internal. */
#ifndef MICROROS_XRCE_STREAM_BEST_EFFORT_SPARE_H
#define MICROROS_XRCE_STREAM_BEST_EFFORT_SPARE_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns room for MICROROS_BEST_EFFORT_SIZE - XRCE_MESSAGE_HEADER bytes of submessages; never NULL. */
uint8_t * xrce_stream_best_effort_spare(void);

/* Sends `size` bytes from there at once, before those that wait. */
void xrce_stream_best_effort_send_spare(xrce_session_t * session, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_BEST_EFFORT_SPARE_H */
