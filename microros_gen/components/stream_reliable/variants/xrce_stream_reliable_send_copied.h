/* SPDX-License-Identifier: Apache-2.0 */
/* Variant for a transport that copies what it sends. */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_SEND_H
#define MICROROS_XRCE_STREAM_RELIABLE_SEND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/* For this component only: sends a message from a slot; the transport copies it. */
static inline bool xrce_stream_reliable_send(xrce_session_t * session, const uint8_t * message, size_t size)
{
  return xrce_session_send(session, message, size);
}

/* For this component only: called before a slot is reused. */
static inline void xrce_stream_reliable_reclaim(xrce_session_t * session, const uint8_t * message)
{
  (void)session;
  (void)message;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_SEND_H */
