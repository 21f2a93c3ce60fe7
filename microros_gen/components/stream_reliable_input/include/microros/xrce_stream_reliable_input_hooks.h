/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_INPUT_HOOKS_H
#define MICROROS_XRCE_STREAM_RELIABLE_INPUT_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether a message belongs to this stream. */
static inline bool xrce_stream_reliable_input_owns(const uint8_t * message)
{
  return message[1] >= XRCE_STREAM_RELIABLE && message[0] == XRCE_SESSION_ID;
}

/* Handles a HEARTBEAT. */
static inline void xrce_stream_reliable_input_take_heartbeat(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  (void)now;
  if (!xrce_stream_reliable_input_on_heartbeat(
        client, xrce_payload_of(submessage), size, xrce_flags_of(submessage))) {
    ++client->session.statistics.malformed;
  }
}

/* Handles a FRAGMENT in a client whose requested samples all fit into its input buffer. */
static inline void xrce_stream_reliable_input_refuse_fragment(
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
