/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "rcl_action/action_server.h"

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
