/* SPDX-License-Identifier: Apache-2.0 */
/* What the session calls of this component, in the functions that component.yaml names. Internal. */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_INPUT_HOOKS_H
#define MICROROS_XRCE_STREAM_RELIABLE_INPUT_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether a message is of this stream. */
static inline bool xrce_stream_reliable_input_owns(const uint8_t * message)
{
  return message[1] >= XRCE_STREAM_RELIABLE && message[0] == XRCE_SESSION_ID;
}

/* Takes a HEARTBEAT. */
static inline void xrce_stream_reliable_input_take_heartbeat(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  (void)now;
  if (!xrce_stream_reliable_input_on_heartbeat(
        client, xrce_payload_of(submessage), size, xrce_flags_of(submessage))) {
    ++client->session.statistics.malformed;
  }
}

/* Takes a FRAGMENT where nothing that this client asks for is larger than its input. */
static inline void xrce_stream_reliable_input_refuse_piece(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  (void)submessage;
  (void)size;
  (void)now;
  ++client->session.statistics.malformed;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_INPUT_HOOKS_H */
