/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the files of the action client. Internal. */
#ifndef MICROROS_RCLC_ACTION_CLIENT_INTERNAL_H
#define MICROROS_RCLC_ACTION_CLIENT_INTERNAL_H

#include "action_msgs/msg/goal_info.h"
#include "microros_config.h"
#include "rclc/action_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An action of the application file. Its arrays have `goals_max` elements. */
typedef struct rclc_action_client_declared_t {
  uint16_t node;
  uint16_t goal_at; /* positions in microros_declared_endpoints */
  uint16_t cancel_at;
  uint16_t result_at;
  uint16_t feedback_at;
  uint16_t goals_max;
  uint32_t response_timeout_ms;
  uint32_t result_timeout_ms; /* 0: none */
  rclc_action_goal_handle_t * goals;
  action_msgs__msg__GoalInfo * canceling;
} rclc_action_client_declared_t;

extern const rclc_action_client_declared_t rclc_action_client_declared[MICROROS_ACTION_CLIENTS];

/* Returns the name of the action's goal service, for texts. */
const char * rclc_action_client_name(const rclc_action_client_t * client);

/* Keeps the first fault of a round. */
void rclc_action_client_note(rclc_action_client_t * client, rcl_ret_t result);

/* --- goals; called with the lock --- */

/* Returns the goal with this id, or NULL. */
rclc_action_goal_handle_t * rclc_action_client_find(
  const rclc_action_client_t * client, const uint8_t * uuid);

/* Returns a free place with a new id, or NULL. */
rclc_action_goal_handle_t * rclc_action_client_take_place(rclc_action_client_t * client);

/* Frees the place; responses that are still to come are discarded. */
void rclc_action_client_free_place(rclc_action_goal_handle_t * goal);

/* Returns whether the handle is that of a goal of an open client. */
bool rclc_action_client_has(const rclc_action_goal_handle_t * goal);

/* --- called by the executor --- */

/* Returns the milliseconds until the next time-out, UINT32_MAX: none. Called with the lock. */
uint32_t rclc_action_client_left(const rclc_action_client_t * client);

/* Returns whether requests for results have to be sent and can be. Called with the lock. */
bool rclc_action_client_has_due(const rclc_action_client_t * client);

/* Takes at most one message of each sort, and marks the goals that they are for. */
void rclc_action_client_take(rclc_action_client_t * client);

/* Calls the callbacks of marked goals, then those of goals whose time is over, and sends requests for results. */
void rclc_action_client_call(rclc_action_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_ACTION_CLIENT_INTERNAL_H */
