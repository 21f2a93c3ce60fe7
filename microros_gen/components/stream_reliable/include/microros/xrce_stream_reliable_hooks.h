/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_HOOKS_H
#define MICROROS_XRCE_STREAM_RELIABLE_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Handles an ACKNACK. */
static inline void xrce_stream_reliable_take_acknack(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  if (!xrce_stream_reliable_on_acknack(
        &client->reliable, &client->session, xrce_payload_of(submessage), size, xrce_flags_of(submessage),
        now)) {
    ++client->session.statistics.malformed;
  }
}

/* Commits the reservation, which always succeeds. */
static inline bool xrce_stream_reliable_put(xrce_client_t * client, size_t size)
{
  xrce_stream_reliable_commit(&client->reliable, &client->session, size, client->session.now_ms);
  return true;
}

/* Returns the time until the stream has work to do, at most `left`. */
static inline uint32_t xrce_stream_reliable_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  const xrce_stream_reliable_t * stream = &client->reliable;

  if (stream->held) {
    return xrce_sooner(left, stream->due_ms, now);
  }
  if (xrce_stream_reliable_is_blocked(stream)) {
    return xrce_turn_blocked(left, now);
  }
  return xrce_stream_reliable_is_idle(stream) ? left : xrce_sooner(left, stream->due_ms, now);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_HOOKS_H */
