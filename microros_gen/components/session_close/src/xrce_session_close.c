/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_session_close.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

enum { DELETE_CLIENT_SIZE = 12, CLOSE_STATUS_SIZE = 6 };

static void leave_send(xrce_session_t * session)
{
  uint8_t message[DELETE_CLIENT_SIZE];

  xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_NONE, 0);
  xrce_put_submessage(&message[4], XRCE_DELETE, XRCE_FLAG_LITTLE_ENDIAN, DELETE_CLIENT_SIZE - 8);
  xrce_put_be16(&message[8], XRCE_REQUEST_LOGOUT);
  xrce_put_be16(&message[10], XRCE_OBJECT_CLIENT);
  (void)xrce_session_send(session, message, sizeof(message)); /* a lost message is repeated */
}

void xrce_session_leave(xrce_client_t * client, uint32_t timeout_ms)
{
  xrce_session_t * session = &client->session;
  const uint32_t start = port_time_ms();
  uint32_t due = start;

  if (session->state != XRCE_READY) {
    return;
  }
  session->state = XRCE_CLOSING;
  for (;;) {
    const uint32_t now = port_time_ms();

    if (xrce_is_due(now, due)) {
      leave_send(session);
      due = now + xrce_session_short_pause(now - start);
    }
    xrce_session_pump(client);
    if (session->state != XRCE_CLOSING || now - start >= timeout_ms) {
      return;
    }
    microros_pause();
  }
}

void xrce_session_leave_on_status(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * payload = xrce_payload_of(submessage);
  xrce_session_t * session = &client->session;

  (void)now;
  if (
    session->state == XRCE_CLOSING && size >= CLOSE_STATUS_SIZE &&
    xrce_get_be16(&payload[0]) == XRCE_REQUEST_LOGOUT && xrce_get_be16(&payload[2]) == XRCE_OBJECT_CLIENT) {
    session->state = XRCE_CLOSED;
  }
}
