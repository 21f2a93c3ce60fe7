/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_guard_condition.h"
#include "microros/wake.h"
#include "microros_config.h"

#include <stddef.h>

rcl_guard_condition_t rcl_get_zero_initialized_guard_condition(void)
{
  const rcl_guard_condition_t guard_condition = {NULL, NULL};

  return guard_condition;
}

rcl_guard_condition_options_t rcl_guard_condition_get_default_options(void)
{
  const rcl_guard_condition_options_t options = {rcl_get_default_allocator()};

  return options;
}

bool rcl_guard_condition_is_valid(const rcl_guard_condition_t * guard_condition)
{
  return guard_condition != NULL && guard_condition->impl != NULL && guard_condition->impl->taken;
}

bool rcl_guard_condition_is_ready(const rcl_guard_condition_t * guard_condition)
{
  return microros_flag_is_set(&guard_condition->impl->is_triggered);
}

void rcl_guard_condition_acknowledge(const rcl_guard_condition_t * guard_condition)
{
  microros_flag_clear(&guard_condition->impl->is_triggered);
}

static rcl_guard_condition_impl_t * guard_condition_take(void)
{
  microros_error_set(
    microros_error_of_pool(microros_error_pool_full, MICROROS_GUARD_CONDITIONS_MAX), "guard_conditions",
    NULL, MICROROS_GUARD_CONDITIONS_MAX, MICROROS_GUARD_CONDITIONS_MAX + 1u);
  return NULL;
}

rcl_ret_t rcl_guard_condition_init(
  rcl_guard_condition_t * guard_condition, rcl_context_t * context,
  const rcl_guard_condition_options_t options)
{
  (void)options;
  if (guard_condition == NULL || context == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "guard_condition or context");
  }
  if (guard_condition->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_executor, "the guard condition is initialized");
  }
  if (!rcl_context_is_valid(context)) {
    return microros_error_refuse(RCL_RET_NOT_INIT, "context");
  }
  microros_lock();
  guard_condition->impl = guard_condition_take();
  microros_unlock();
  if (guard_condition->impl == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  guard_condition->context = context;
  return RCL_RET_OK;
}

rcl_ret_t rcl_guard_condition_fini(rcl_guard_condition_t * guard_condition)
{
  if (guard_condition == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "guard_condition");
  }
  if (guard_condition->impl != NULL) {
    microros_lock();
    guard_condition->impl->taken = false;
    microros_unlock();
    guard_condition->impl = NULL;
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_trigger_guard_condition(rcl_guard_condition_t * guard_condition)
{
  if (!rcl_guard_condition_is_valid(guard_condition)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "guard_condition");
  }
  microros_flag_set(&guard_condition->impl->is_triggered);
  microros_wake();
  return RCL_RET_OK;
}
