/* SPDX-License-Identifier: Apache-2.0 */
/* What `on_full: drop_oldest` removes from the stream. */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_DROP_H
#define MICROROS_XRCE_STREAM_RELIABLE_DROP_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"
#include "microros/xrce_stream_reliable_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Drops the oldest message of which nothing was sent. What was sent stays, except in a stream of a single slot for
 * whole messages, over which the next step sends a HEARTBEAT. Returns the submessages, valid until the next reservation; NULL if
 * there is nothing to drop. */
const uint8_t * xrce_stream_reliable_drop_oldest(
  xrce_stream_reliable_t * stream, const xrce_session_t * session, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_DROP_H */
