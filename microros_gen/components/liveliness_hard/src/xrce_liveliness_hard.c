/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_liveliness_hard.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

enum { SHARE = 3 };

static void hard_assert_liveliness(xrce_session_t * session)
{
  uint8_t message[XRCE_GET_INFO_SIZE];

  xrce_put_get_info(message, XRCE_SESSION_ID);
  (void)xrce_session_send(session, message, sizeof(message)); /* two attempts remain */
}

void xrce_liveliness_hard_step(xrce_client_t * client, uint32_t now)
{
  xrce_liveliness_hard_t * hard = &client->hard;
  xrce_session_t * session = &client->session;

  if (
    session->state == (uint8_t)XRCE_READY && hard->sent == session->statistics.sent &&
    xrce_is_due(now, hard->due_ms)) {
    hard_assert_liveliness(session);
    hard->due_ms = now + MICROROS_HARD_LIVELINESS_MS / SHARE;
  }
  if (hard->sent != session->statistics.sent) {
    hard->sent = session->statistics.sent;
    hard->due_ms = now + MICROROS_HARD_LIVELINESS_MS / SHARE;
  }
}

void xrce_liveliness_hard_on_get_info(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  (void)submessage;
  (void)size;
  client->hard.due_ms = now;
}
