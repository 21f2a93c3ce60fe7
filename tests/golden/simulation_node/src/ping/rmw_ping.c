/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/ping.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_transport.h"
#include "microros/xrce_client.h"
#include "microros/xrce_ping.h"
#include "microros/xrce_wire.h"

/* Whether `message` begins with an INFO. */
static bool ping_is_info(const uint8_t * message, int32_t size)
{
  return size > XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER && message[4] == XRCE_INFO;
}

static bool ping_in_session(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  uint8_t message[XRCE_PING_SIZE];

  client->ping.answered = false;
  xrce_ping_write(message, XRCE_SESSION_ID);
  (void)xrce_session_send(&client->session, message, sizeof(message));
  for (;;) {
    xrce_session_pump(client);
    if (
      client->ping.answered || client->session.state != XRCE_READY || port_time_ms() - start >= timeout_ms) {
      break;
    }
    microros_pause();
  }
  return client->ping.answered;
}

/* `input` holds MICROROS_INPUT_SIZE bytes. */
static bool ping_once(xrce_transport_t * transport, uint8_t * input, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  uint8_t message[XRCE_PING_SIZE];

  xrce_ping_write(message, XRCE_SESSION_NONE);
  (void)xrce_transport_send(transport, message, sizeof(message));
  for (;;) {
    if (ping_is_info(input, xrce_transport_receive(transport, input, MICROROS_INPUT_SIZE))) {
      return true;
    }
    if (port_time_ms() - start >= timeout_ms) {
      return false;
    }
    port_sleep_ms(1);
  }
}

static bool ping_out_of_session(xrce_transport_t * transport, uint32_t timeout_ms, uint8_t attempts)
{
  uint8_t input[MICROROS_INPUT_SIZE];
  bool answered = false;

  if (!xrce_transport_open(transport)) {
    return false;
  }
  for (uint8_t i = 0; i < attempts && !answered; ++i) {
    answered = ping_once(transport, input, timeout_ms);
  }
  xrce_transport_close(transport);
  return answered;
}

static rmw_ret_t ping_agent(const rmw_uxrce_transport_params_t * params, int timeout_ms, uint8_t attempts)
{
  const uint32_t timeout = timeout_ms > 0 ? (uint32_t)timeout_ms : 0u;
  xrce_transport_t transport;

  if (!rmw_transport_prepare(&transport, params)) {
    return RMW_RET_ERROR;
  }
  if (!ping_out_of_session(&transport, timeout, attempts)) {
    microros_error_set(
      microros_error_agent_silent, xrce_transport_name(&transport), NULL, xrce_transport_port(&transport),
      timeout * attempts);
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
}

/* The lock is held but where it waits. */
static bool ping_session(xrce_client_t * client, int timeout_ms, uint8_t attempts)
{
  bool answered = false;

  for (uint8_t i = 0; i < attempts && !answered; ++i) {
    answered = ping_in_session(client, timeout_ms > 0 ? (uint32_t)timeout_ms : 0u);
  }
  return answered;
}

rmw_ret_t rmw_uros_ping_agent(const int timeout_ms, const uint8_t attempts)
{
  static const rmw_uxrce_transport_params_t planned = {0};
  xrce_client_t * client;
  bool answered = false;

  microros_lock();
  client = rmw_client_connected();
  if (client != NULL) {
    answered = ping_session(client, timeout_ms, attempts);
  }
  microros_unlock();
  if (client == NULL) {
    return ping_agent(&planned, timeout_ms, attempts);
  }
  return answered ? RMW_RET_OK : RMW_RET_ERROR;
}

rmw_ret_t rmw_uros_ping_agent_options(
  const int timeout_ms, const uint8_t attempts, rmw_init_options_t * rmw_options)
{
  if (rmw_options == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "rmw_options");
  }
  return ping_agent(&rmw_options->transport_params, timeout_ms, attempts);
}
