/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/timing.h"

#include "microros/error.h"
#include "microros/xrce_client.h"

#include <stdbool.h>
#include <stddef.h>

static bool timing_is_valid(const rmw_context_t * context, int session_timeout)
{
  if (context == NULL || context->impl == NULL || session_timeout < 0) {
    microros_error_set(microros_error_argument, "context or session_timeout", NULL, 0, 0);
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
