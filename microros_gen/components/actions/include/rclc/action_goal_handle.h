/* SPDX-License-Identifier: Apache-2.0 */
/* A goal, as callbacks of the application get it. */
#ifndef MICROROS_RCLC_ACTION_GOAL_HANDLE_H
#define MICROROS_RCLC_ACTION_GOAL_HANDLE_H

#include <stdbool.h>
#include <stdint.h>

#include "builtin_interfaces/msg/time.h"
#include "microros_config.h"
#include "rcl_action/rcl_action.h"
#include "rmw/types.h"
#include "unique_identifier_msgs/msg/uuid.h"

#ifdef __cplusplus
extern "C" {
#endif

struct Generic_SendGoal_Request;
struct rclc_action_server_t;

/*
 * Belongs to the library, which uses it again once the goal has ended: the application does not keep it longer.
 * It reads the members up to `goal_cancelled`, from any task.
 */
typedef struct rclc_action_goal_handle_t {
  struct rclc_action_server_t * action_server;
  struct Generic_SendGoal_Request * ros_goal_request; /* cast to <pkg>__action__<Type>_SendGoal_Request * */
  unique_identifier_msgs__msg__UUID goal_id;
  volatile rcl_action_goal_state_t status;
  volatile bool goal_cancelled; /* its cancel request was accepted: end the goal soon */

  bool is_used;
  bool result_sent;
  uint8_t waiting; /* result requests */
  rmw_request_id_t result_requests[MICROROS_ACTION_RESULT_REQUESTS];
  builtin_interfaces__msg__Time stamp; /* of acceptance */
  uint32_t ended_ms;
  uint32_t result_size; /* of the encoded response */
} rclc_action_goal_handle_t;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_ACTION_GOAL_HANDLE_H */
