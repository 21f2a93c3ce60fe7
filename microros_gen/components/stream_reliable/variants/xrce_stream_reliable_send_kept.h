/* SPDX-License-Identifier: Apache-2.0 */
/* Variant for a transport that sends directly from the slots. */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_SEND_H
#define MICROROS_XRCE_STREAM_RELIABLE_SEND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * For this component only: sends a message from a slot, which stays unchanged until the slot is reserved
 * again. */
static inline bool xrce_stream_reliable_send(xrce_session_t * session, const uint8_t * message, size_t size)
{
  /* cppcheck-suppress knownConditionTrueFalse ; without tasks of the application file every task sends */
  if (!xrce_turn_is_mine()) {
    return false;
  }
  if (!session->transport_open || !xrce_transport_send_kept(&session->transport, message, size)) {
    return false;
  }
  ++session->statistics.sent;
  return true;
}

/* For this component only: called before a slot is reused, whose message may currently be repeated. */
static inline void xrce_stream_reliable_reclaim(xrce_session_t * session, const uint8_t * message)
{
  xrce_transport_take_back(&session->transport, message);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_SEND_H */
