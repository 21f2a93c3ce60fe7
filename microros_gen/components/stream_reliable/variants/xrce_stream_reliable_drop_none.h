/* SPDX-License-Identifier: Apache-2.0 */
/* Variant for a stream that keeps every message until it is acknowledged. */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_DROP_H
#define MICROROS_XRCE_STREAM_RELIABLE_DROP_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"
#include "microros/xrce_stream_reliable_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* For a caller of every kind of storage: there is nothing to drop. */
static inline const uint8_t * xrce_stream_reliable_drop_oldest(
  const xrce_stream_reliable_t * stream, const xrce_session_t * session, uint32_t now)
{
  (void)stream;
  (void)session;
  (void)now;
  return NULL;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_DROP_H */
