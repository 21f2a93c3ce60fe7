/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "rclc/executor.h"

/* Handles that were ready under another trigger count as new for this one. */
rcl_ret_t rclc_executor_set_trigger(
  rclc_executor_t * executor, rclc_executor_trigger_t trigger_function, void * trigger_object)
{
  if (executor == NULL || trigger_function == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "executor or trigger_function");
  }
  executor->trigger_function = trigger_function;
  executor->trigger_object = trigger_object;
  for (size_t i = 0; i < executor->index; ++i) {
    executor->handles[i].data_available = false;
  }
  return RCL_RET_OK;
}

bool rclc_executor_trigger_all(rclc_executor_handle_t * handles, unsigned int size, void * obj)
{
  (void)obj;
  if (handles == NULL) {
    return false;
  }
  for (unsigned int i = 0; i < size && handles[i].initialized; ++i) {
    if (!handles[i].data_available) {
      return false;
    }
  }
  return true;
}

bool rclc_executor_trigger_any(rclc_executor_handle_t * handles, unsigned int size, void * obj)
{
  (void)obj;
  if (handles == NULL) {
    return false;
  }
  for (unsigned int i = 0; i < size && handles[i].initialized; ++i) {
    if (handles[i].data_available) {
      return true;
    }
  }
  return false;
}

bool rclc_executor_trigger_one(rclc_executor_handle_t * handles, unsigned int size, void * obj)
{
  if (handles == NULL) {
    return false;
  }
  for (unsigned int i = 0; i < size && handles[i].initialized; ++i) {
    if (handles[i].data_available && rclc_executor_handle_get_ptr(&handles[i]) == obj) {
      return true;
    }
  }
  return false;
}

bool rclc_executor_trigger_always(rclc_executor_handle_t * handles, unsigned int size, void * obj)
{
  (void)handles;
  (void)size;
  (void)obj;
  return true;
}
