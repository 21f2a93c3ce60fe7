/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/executor_handles.h"
#include "microros/rclc_modes_known.h"
#include "microros/rclc_modes_table.h"
#include "microros/rmw_service.h"

#include <stddef.h>

static rclc_handle_kind_t modes_kind; /* that of a service, which also publishes an event that waits */

/* As for a service. Its function is not called here: the call through a pointer would look like a recursion. */
static rcl_ret_t modes_look(const rclc_executor_handle_t * handle, bool * is_ready, int64_t * look_again_ns)
{
  (void)look_again_ns;
  if (!rcl_service_is_valid(handle->service)) {
    return microros_error_refuse(RCL_RET_SERVICE_INVALID, "service");
  }
  rclc_modes_publish(handle->callback_context);
  *is_ready =
    rmw_replier_is_ready(handle->service->impl) || rclc_modes_is_requested(handle->callback_context);
  return RCL_RET_OK;
}

bool rclc_modes_has_handle(const rclc_executor_handle_t * handle)
{
  return handle->kind == &modes_kind;
}

/* Responses are written from the modes, by the encoders of their types. */
static void modes_reply(const void * request, void * response, void * context)
{
  (void)request;
  (void)response;
  (void)context;
}

static void modes_reply_change(const void * request, void * response, void * context)
{
  rclc_modes_t * modes = context;

  (void)request;
  (void)response;
  modes->succeeded = rclc_modes_change(modes, modes->requested) == RCL_RET_OK;
  if (!modes->succeeded) {
    rcl_reset_error(); /* the response tells */
  }
}

rcl_ret_t rclc_executor_add_modes(
  rclc_executor_t * executor, rclc_modes_t * modes, rclc_modes_callback_t on_change, void * context)
{
  rcl_ret_t result = RCL_RET_OK;

  if (executor == NULL || rclc_modes_get(modes) == (uint8_t)RCLC_MODES_NONE) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor or modes");
  }
  modes->on_change = on_change;
  modes->context = context;
  for (size_t i = 0; i < (size_t)RCLC_EXECUTOR_MODES_HANDLES && result == RCL_RET_OK; ++i) {
    result = rclc_executor_add_service_with_context(
      executor, &modes->services[i], modes, modes, i == 0u ? modes_reply_change : modes_reply, modes);
  }
  if (result == RCL_RET_OK) {
    rclc_executor_handle_t * handle = &executor->handles[executor->index - 1u];

    modes_kind = *handle->kind;
    modes_kind.look = modes_look;
    handle->kind = &modes_kind;
  }
  return result;
}
