/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wait_left.h"
#include "rmw_microros/session.h"

#include <stddef.h>

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
