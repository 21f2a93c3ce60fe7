/* SPDX-License-Identifier: Apache-2.0 */
/* Hooks called by the session, as declared in component.yaml. Internal. */
#ifndef MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_HOOKS_H
#define MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether a message contains samples older than those already processed. */
static inline bool xrce_stream_best_effort_input_is_old(
  xrce_client_t * client, const uint8_t * message, size_t size)
{
  return size > XRCE_MESSAGE_HEADER && message[XRCE_MESSAGE_HEADER] == XRCE_DATA &&
         message[0] == XRCE_SESSION_ID && message[1] >= XRCE_STREAM_BEST_EFFORT &&
         message[1] < XRCE_STREAM_RELIABLE &&
         !xrce_stream_best_effort_input_take(&client->best_effort_input, xrce_get_le16(&message[2]));
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_HOOKS_H */
