/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "rcl_action/types.h"

rcl_action_goal_status_array_t rcl_action_get_zero_initialized_goal_status_array(void)
{
  rcl_action_goal_status_array_t status_array;

  (void)memset(&status_array, 0, sizeof(status_array));
  return status_array;
}

rcl_ret_t rcl_action_goal_status_array_init(
  rcl_action_goal_status_array_t * status_array, const size_t num_status, const rcl_allocator_t allocator)
{
  void * statuses;

  if (!rcutils_allocator_is_valid(&allocator) || status_array == NULL || num_status == 0u) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "status_array, num_status or allocator");
  }
  if (status_array->msg.status_list.size != 0u) {
    return microros_error_refuse(RCL_RET_ALREADY_INIT, "status_array");
  }
  statuses = allocator.zero_allocate(num_status, sizeof(rcl_action_goal_status_t), allocator.state);
  if (statuses == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  status_array->msg.status_list.data = statuses;
  status_array->msg.status_list.size = num_status;
  status_array->msg.status_list.capacity = num_status;
  status_array->allocator = allocator;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_goal_status_array_fini(rcl_action_goal_status_array_t * status_array)
{
  if (status_array == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "status_array");
  }
  if (status_array->msg.status_list.data != NULL) {
    status_array->allocator.deallocate(status_array->msg.status_list.data, status_array->allocator.state);
    status_array->msg.status_list.data = NULL;
    status_array->msg.status_list.size = 0u;
    status_array->msg.status_list.capacity = 0u;
  }
  return RCL_RET_OK;
}
