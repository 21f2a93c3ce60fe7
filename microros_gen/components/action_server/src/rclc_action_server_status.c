/* SPDX-License-Identifier: Apache-2.0 */
#include "action_msgs/msg/goal_status_array.h"
#include "microros/lock.h"
#include "microros/rclc_action_server.h"
#include "microros/rmw_action_server.h"
#include "microros/rmw_client.h"

bool rclc_action_has_status(const rclc_action_server_t * server)
{
  const bool is_due = server->status_due || server->session != (uint8_t)rmw_client_reconnects();

  return is_due && rmw_action_server_may_publish(server->rcl_handle.status_publisher.impl);
}

/* Called with the lock. */
static size_t action_status_fill(const rclc_action_server_t * server)
{
  size_t count = 0;

  /* at most MICROROS_ACTION_SERVER_GOALS rounds */
  for (size_t i = 0; i < server->goal_handles_memory_size; ++i) {
    const rclc_action_goal_handle_t * goal = &server->declared->goals[i];

    if (goal->is_used && goal->status != GOAL_STATE_UNKNOWN) {
      server->declared->statuses[count].goal_info.goal_id = goal->goal_id;
      server->declared->statuses[count].goal_info.stamp = goal->stamp;
      server->declared->statuses[count].status = goal->status;
      ++count;
    }
  }
  return count;
}

rcl_ret_t rclc_action_publish_status(rclc_action_server_t * server)
{
  action_msgs__msg__GoalStatusArray message;
  rcl_ret_t result;

  microros_lock();
  message.status_list.data = server->declared->statuses;
  message.status_list.size = action_status_fill(server);
  message.status_list.capacity = server->declared->goals_max;
  server->session = (uint8_t)rmw_client_reconnects();
  result = rcl_publish(&server->rcl_handle.status_publisher, &message, NULL);
  server->status_due = result != RCL_RET_OK;
  microros_unlock();
  return result;
}
