/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_client.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_mark.h"
#include "microros/xrce_rest.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_session_spin.h"
#include "microros/xrce_wait_left.h"
#include "rmw_microros/init_options.h"
#include "rmw_microros/session.h"
#include "rmw_microros/timing.h"

#include <stdbool.h>
#include <stddef.h>

const char * const rmw_implementation_identifier = "rmw_microros_gen";

static xrce_client_t instance;

xrce_client_t * rmw_client_instance(void)
{
  return &instance;
}

uint32_t rmw_client_key(void)
{
  uint32_t result;

  microros_lock();
  result = instance.session.key;
  microros_unlock();
  return result;
}

uint32_t rmw_client_reconnects(void)
{
  uint32_t result;

  microros_lock();
  result = instance.session.statistics.reconnects;
  microros_unlock();
  return result;
}

/* Best-effort messages go through the queue, then to the transport, then over its line, in order. */
static bool client_has_sent(xrce_session_t * session, xrce_mark_t * mark)
{
  if (!mark->is_handed) {
    const bool has_passed = xrce_output_queue_has_passed(mark);

    mark->is_handed = has_passed && xrce_turn_is_sent();
  }
  if (mark->is_handed && !mark->is_sent) {
    mark->is_sent = xrce_transport_is_idle(&session->transport);
  }
  return mark->is_sent || !session->transport_open;
}

/* Returns whether all is acknowledged or sent that was stored at the first call. */
static bool client_has_passed(xrce_client_t * client, xrce_mark_t * mark)
{
  const bool is_sent = client_has_sent(&client->session, mark);

  return xrce_route_has_passed(client, mark) && is_sent;
}

bool rmw_client_flush(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  xrce_mark_t mark = xrce_mark_new();
  bool flushed;

  microros_lock();
  (void)client_has_passed(client, &mark);
  for (;;) {
    xrce_session_pump(client);
    flushed = client_has_passed(client, &mark);
    if (flushed || port_time_ms() - start >= timeout_ms) {
      break;
    }
    xrce_rest(client);
  }
  microros_unlock();
  return flushed;
}

static bool session_is_open(const rmw_context_t * context)
{
  if (context == NULL || context->impl == NULL) {
    (void)microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "context");
    return false;
  }
  return true;
}

rmw_ret_t rmw_uros_get_statistics(const rmw_context_t * context, rmw_uros_statistics_t * statistics)
{
  const xrce_statistics_t * counted;

  if (statistics == NULL || !session_is_open(context)) {
    return RMW_RET_INVALID_ARGUMENT;
  }
  microros_lock();
  counted = &context->impl->session.statistics;
  statistics->sent = counted->sent;
  statistics->resent = counted->resent;
  statistics->received = counted->received;
  statistics->malformed = counted->malformed;
  statistics->dropped = counted->dropped;
  statistics->reconnects = counted->reconnects;
  statistics->refused = counted->refused;
  microros_unlock();
  return RMW_RET_OK;
}

bool rmw_uros_is_connected(const rmw_context_t * context)
{
  bool connected;

  microros_lock();
  connected = context != NULL && context->impl != NULL && context->impl->session.state == XRCE_READY &&
              xrce_route_settled(context->impl);
  microros_unlock();
  return connected;
}

rmw_ret_t rmw_uros_spin_once(rmw_context_t * context)
{
  if (!session_is_open(context)) {
    return RMW_RET_INVALID_ARGUMENT;
  }
  xrce_session_spin(context->impl);
  return RMW_RET_OK;
}

rmw_ret_t rmw_uros_flush(rmw_context_t * context, uint32_t timeout_ms)
{
  if (!session_is_open(context)) {
    return RMW_RET_INVALID_ARGUMENT;
  }
  return rmw_client_flush(context->impl, timeout_ms) ? RMW_RET_OK : RMW_RET_TIMEOUT;
}

rmw_ret_t rmw_uros_time_until_due(const rmw_context_t * context, int64_t * duration_ns)
{
  const int64_t ns_per_ms = 1000000;
  uint32_t left_ms;

  if (context == NULL || context->impl == NULL || duration_ns == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "context or duration_ns");
  }
  microros_lock();
  left_ms = xrce_wait_left(context->impl, UINT32_MAX);
  microros_unlock();
  *duration_ns = (left_ms != UINT32_MAX) ? ((int64_t)left_ms * ns_per_ms) : INT64_MAX;
  return RMW_RET_OK;
}

rmw_ret_t rmw_uros_options_set_client_key(uint32_t client_key, rmw_init_options_t * rmw_options)
{
  if (rmw_options == NULL || client_key == 0u) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "client_key or rmw_options");
  }
  rmw_options->transport_params.client_key = client_key;
  return RMW_RET_OK;
}

static bool timing_is_valid(const rmw_context_t * context, int session_timeout)
{
  if (context == NULL || context->impl == NULL || session_timeout < 0) {
    (void)microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "context or session_timeout");
    return false;
  }
  return true;
}

rmw_ret_t rmw_uros_set_context_entity_creation_session_timeout(rmw_context_t * context, int session_timeout)
{
  if (!timing_is_valid(context, session_timeout)) {
    return RMW_RET_INVALID_ARGUMENT;
  }
  context->impl->create_timeout_ms = (uint32_t)session_timeout;
  return RMW_RET_OK;
}

rmw_ret_t rmw_uros_set_context_entity_destroy_session_timeout(rmw_context_t * context, int session_timeout)
{
  if (!timing_is_valid(context, session_timeout)) {
    return RMW_RET_INVALID_ARGUMENT;
  }
  context->impl->close_timeout_ms = (uint32_t)session_timeout;
  return RMW_RET_OK;
}
