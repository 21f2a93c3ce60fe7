/* SPDX-License-Identifier: Apache-2.0 */
/* Receives one message. Only for xrce_session.c and xrce_session_spin.c: a copy each. */
#ifndef MICROROS_XRCE_SESSION_TAKE_H
#define MICROROS_XRCE_SESSION_TAKE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_client.h"
#include "microros/xrce_input.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_turn_bytes.h"
#include "microros/xrce_wire.h"

/* Passes a message to its stream; returns false for a malformed message. */
static inline bool session_take_message(
  xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now)
{
  const uint32_t in_session = (uint32_t)XRCE_SESSION_ID ^ (uint32_t)XRCE_SESSION_NONE;

  /* The two ids differ in one bit: one constant less is kept in a register while messages are received. */
  if (size < XRCE_MESSAGE_HEADER || (message[0] & ~in_session) != (uint32_t)XRCE_SESSION_NONE) {
    return false;
  }
  if ((message[0] & in_session) != 0u) {
    client->session.received_ms = now;
  }
  return xrce_route_message(client, message, size, now);
}

/* Returns whether a message had arrived, or a part of one and perhaps more. The transport is open. */
static inline bool xrce_session_take(xrce_client_t * client, uint32_t now)
{
  xrce_session_t * session = &client->session;
  const int32_t size = xrce_transport_receive(&session->transport, xrce_input, MICROROS_INPUT_SIZE);

  if (size == 0) {
    return false;
  }
  /* cppcheck-suppress knownConditionTrueFalse ; without a task for the session nothing is partial */
  if (xrce_turn_is_partial(size)) {
    return true;
  }
  ++session->statistics.received;
  if (size < 0 || !session_take_message(client, xrce_input, (size_t)size, now)) {
    ++session->statistics.malformed;
  }
  return true;
}

#endif /* MICROROS_XRCE_SESSION_TAKE_H */
