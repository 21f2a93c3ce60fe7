/* SPDX-License-Identifier: Apache-2.0 */
/* Servers of actions as rcl has them, the states that they publish, and the handles of their goals. */
#include "rcl_action/action_server.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "rcl_action/goal_handle.h"
#include "rcl_action/types.h"
#include "rclc/action_goal_handle.h"

#include <stddef.h>

rcl_action_server_t rcl_action_get_zero_initialized_server(void)
{
  const rcl_action_server_t server = {{NULL}, {NULL}, {NULL}, {NULL}, {NULL}};

  return server;
}

bool rcl_action_server_is_valid(const rcl_action_server_t * action_server)
{
  return action_server != NULL && rcl_service_is_valid(&action_server->goal_service) &&
         rcl_service_is_valid(&action_server->cancel_service) &&
         rcl_service_is_valid(&action_server->result_service) &&
         rcl_publisher_is_valid(&action_server->feedback_publisher) &&
         rcl_publisher_is_valid(&action_server->status_publisher);
}

bool rcl_action_server_is_valid_except_context(const rcl_action_server_t * action_server)
{
  return action_server != NULL && action_server->goal_service.impl != NULL &&
         action_server->cancel_service.impl != NULL && action_server->result_service.impl != NULL &&
         rcl_publisher_is_valid_except_context(&action_server->feedback_publisher) &&
         rcl_publisher_is_valid_except_context(&action_server->status_publisher);
}

static rcl_ret_t action_publish_check(const rcl_action_server_t * action_server, const void * message)
{
  if (!rcl_action_server_is_valid(action_server)) {
    return microros_error_refuse(RCL_RET_ACTION_SERVER_INVALID, "action_server");
  }
  return message == NULL ? microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "message") : RCL_RET_OK;
}

rcl_ret_t rcl_action_publish_feedback(const rcl_action_server_t * action_server, void * ros_feedback)
{
  const rcl_ret_t result = action_publish_check(action_server, ros_feedback);

  return result == RCL_RET_OK ? rcl_publish(&action_server->feedback_publisher, ros_feedback, NULL) : result;
}

rcl_ret_t rcl_action_publish_status(const rcl_action_server_t * action_server, const void * status_message)
{
  const rcl_ret_t result = action_publish_check(action_server, status_message);

  return result == RCL_RET_OK ? rcl_publish(&action_server->status_publisher, status_message, NULL) : result;
}

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

rcl_action_goal_handle_t rcl_action_get_zero_initialized_goal_handle(void)
{
  const rcl_action_goal_handle_t goal_handle = {NULL};

  return goal_handle;
}

bool rcl_action_goal_handle_is_valid(const rcl_action_goal_handle_t * goal_handle)
{
  if (goal_handle == NULL || goal_handle->impl == NULL || !goal_handle->impl->is_used) {
    (void)microros_error_refuse(RCL_RET_ACTION_GOAL_HANDLE_INVALID, "goal_handle");
    return false;
  }
  return true;
}

rcl_ret_t rcl_action_goal_handle_get_info(
  const rcl_action_goal_handle_t * goal_handle, rcl_action_goal_info_t * goal_info)
{
  rcl_ret_t result = RCL_RET_ACTION_GOAL_HANDLE_INVALID;

  microros_lock();
  if (rcl_action_goal_handle_is_valid(goal_handle)) {
    if (goal_info != NULL) {
      goal_info->goal_id = goal_handle->impl->goal_id;
      goal_info->stamp = goal_handle->impl->stamp;
      result = RCL_RET_OK;
    } else {
      result = microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "goal_info");
    }
  }
  microros_unlock();
  return result;
}

rcl_ret_t rcl_action_goal_handle_get_status(
  const rcl_action_goal_handle_t * goal_handle, rcl_action_goal_state_t * status)
{
  rcl_ret_t result = RCL_RET_ACTION_GOAL_HANDLE_INVALID;

  microros_lock();
  if (rcl_action_goal_handle_is_valid(goal_handle)) {
    if (status != NULL) {
      *status = goal_handle->impl->status;
      result = RCL_RET_OK;
    } else {
      result = microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "status");
    }
  }
  microros_unlock();
  return result;
}

bool rcl_action_goal_handle_is_active(const rcl_action_goal_handle_t * goal_handle)
{
  rcl_action_goal_state_t status;

  return rcl_action_goal_handle_get_status(goal_handle, &status) == RCL_RET_OK &&
         status != GOAL_STATE_UNKNOWN && status <= GOAL_STATE_CANCELING;
}

bool rcl_action_goal_handle_is_cancelable(const rcl_action_goal_handle_t * goal_handle)
{
  rcl_action_goal_state_t status;

  return rcl_action_goal_handle_get_status(goal_handle, &status) == RCL_RET_OK &&
         rcl_action_transition_goal_state(status, GOAL_EVENT_CANCEL_GOAL) == GOAL_STATE_CANCELING;
}
