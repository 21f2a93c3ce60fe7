/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/session.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_session_spin.h"

#include <stddef.h>

static bool session_is_open(const rmw_context_t * context)
{
  if (context == NULL || context->impl == NULL) {
    microros_error_set(microros_error_argument, "context", NULL, 0, 0);
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
