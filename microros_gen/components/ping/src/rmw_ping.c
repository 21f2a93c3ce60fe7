/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/ping.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_inquiry.h"
#include "microros/rmw_ping_search.h"
#include "microros/rmw_transport.h"
#include "microros/xrce_client.h"
#include "microros/xrce_ping.h"
#include "microros/xrce_rest.h"

static rmw_ret_t ping_silent(const xrce_transport_t * transport, uint32_t waited_ms)
{
  microros_error_set(
    microros_error_agent_silent, xrce_transport_name(transport), NULL, xrce_transport_port(transport),
    waited_ms);
  return RMW_RET_ERROR;
}

/* A session that is open or reconnecting owns the line: no other transport may use it. */
static bool ping_over_session(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  const uint8_t replies = client->ping.replies;

  xrce_turn_borrow();
  xrce_ping_request(client);
  xrce_turn_return(client);
  for (;;) {
    xrce_session_pump(client);
    if (client->ping.replies != replies) {
      return true;
    }
    if (client->session.state == (uint8_t)XRCE_CLOSED || port_time_ms() - start >= timeout_ms) {
      return false;
    }
    xrce_rest(client);
  }
}

static rmw_ret_t ping_session(xrce_client_t * client, uint32_t timeout_ms, uint8_t attempts)
{
  for (uint8_t i = 0; i < attempts && client->session.state != (uint8_t)XRCE_CLOSED; ++i) {
    if (ping_over_session(client, timeout_ms)) {
      return RMW_RET_OK;
    }
  }
  return ping_silent(&client->session.transport, timeout_ms * attempts);
}

/* For an address other than the session's. */
static rmw_ret_t ping_place(
  const rmw_uxrce_transport_params_t * params, uint32_t timeout_ms, uint8_t attempts)
{
  xrce_client_t * client = rmw_client_instance();
  xrce_transport_t transport;

  if (!rmw_transport_prepare(&transport, params)) {
    return RMW_RET_ERROR;
  }
  if (
    client->session.state != (uint8_t)XRCE_CLOSED &&
    xrce_transport_is_same_line(&transport, &client->session.transport)) {
    return ping_session(client, timeout_ms, attempts);
  }
  return rmw_inquiry_run(&transport, timeout_ms, attempts) ? RMW_RET_OK
                                                           : ping_silent(&transport, timeout_ms * attempts);
}

static rmw_ret_t ping_agent(
  const rmw_uxrce_transport_params_t * params, uint32_t timeout_ms, uint8_t attempts)
{
  if (rmw_ping_searches(params)) {
    return rmw_ping_search(params, timeout_ms * attempts);
  }
  return ping_place(params, timeout_ms, attempts);
}

rmw_ret_t rmw_uros_ping_agent(const int timeout_ms, const uint8_t attempts)
{
  static const rmw_uxrce_transport_params_t planned = {0};
  const uint32_t timeout = timeout_ms > 0 ? (uint32_t)timeout_ms : 0u;
  xrce_client_t * client = rmw_client_instance();
  rmw_ret_t result;

  microros_lock();
  rmw_inquiry_await();
  result = client->session.state != (uint8_t)XRCE_CLOSED ? ping_session(client, timeout, attempts)
                                                         : ping_agent(&planned, timeout, attempts);
  microros_unlock();
  return result;
}

rmw_ret_t rmw_uros_ping_agent_options(
  const int timeout_ms, const uint8_t attempts, rmw_init_options_t * rmw_options)
{
  rmw_ret_t result;

  if (rmw_options == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "rmw_options");
  }
  microros_lock();
  rmw_inquiry_await();
  result = ping_agent(&rmw_options->transport_params, timeout_ms > 0 ? (uint32_t)timeout_ms : 0u, attempts);
  microros_unlock();
  return result;
}
