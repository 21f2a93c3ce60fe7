/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_inquiry.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"
#include "microros/xrce_input.h"
#include "microros/xrce_wire.h"

/* The agent's INFO has 36 bytes; anything longer than this is not an INFO. */
enum { INPUT_SIZE = 40 };

/* An open session may keep part of a message in its input buffer. */
static uint8_t inquiry_input[INPUT_SIZE];

/* Without a session other tasks could only open one, maybe over this line: they have to wait. */
static void inquiry_wait(void)
{
  if (rmw_client_instance()->session.state == (uint8_t)XRCE_CLOSED) {
    port_sleep_ms(1);
  } else {
    microros_pause();
  }
}

/* Returns whether `message` starts with an INFO. */
static bool inquiry_is_info(const uint8_t * message, int32_t size)
{
  return size > XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER && message[XRCE_MESSAGE_HEADER] == XRCE_INFO;
}

static void inquiry_send(xrce_transport_t * transport)
{
  uint8_t message[XRCE_GET_INFO_SIZE];

  xrce_put_get_info(message, XRCE_SESSION_NONE);
  (void)xrce_transport_send(transport, message, sizeof(message)); /* a lost message just remains unanswered */
}

static bool inquiry_attempt(xrce_transport_t * transport, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  uint8_t * input = inquiry_input;

  inquiry_send(transport);
  for (;;) {
    const int32_t size = xrce_transport_receive(transport, input, INPUT_SIZE);

    if (inquiry_is_info(input, size)) {
      return true;
    }
    if (port_time_ms() - start >= timeout_ms) {
      return false;
    }
    if (size == 0) {
      inquiry_wait();
    }
  }
}

/* Asks over an open transport. */
static bool inquiry_run_attempts(xrce_transport_t * transport, uint32_t timeout_ms, uint8_t attempts)
{
  bool answered = false;

  for (uint8_t i = 0; i < attempts && !answered; ++i) {
    answered = inquiry_attempt(transport, timeout_ms);
  }
  xrce_transport_close(transport);
  return answered;
}

bool rmw_inquiry_run(xrce_transport_t * transport, uint32_t timeout_ms, uint8_t attempts)
{
  return xrce_transport_open(transport) && inquiry_run_attempts(transport, timeout_ms, attempts);
}
