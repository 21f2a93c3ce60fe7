/* SPDX-License-Identifier: Apache-2.0 */
/* The server of an action below rclc: what it has open. */
#ifndef MICROROS_RCL_ACTION_ACTION_SERVER_H
#define MICROROS_RCL_ACTION_ACTION_SERVER_H

#include <stdbool.h>
#include <stddef.h>

#include "rcl/macros.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/service.h"
#include "rcl_action/goal_handle.h"
#include "rcl_action/types.h"
#include "rcl_action/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Belongs to rclc_action_server_t. */
typedef struct rcl_action_server_s {
  rcl_service_t goal_service;
  rcl_service_t cancel_service;
  rcl_service_t result_service;
  rcl_publisher_t feedback_publisher;
  rcl_publisher_t status_publisher;
} rcl_action_server_t;

rcl_action_server_t rcl_action_get_zero_initialized_server(void);

/* Returns whether it is open. */
bool rcl_action_server_is_valid(const rcl_action_server_t * action_server);

/* Same, but also if its context was shut down. */
bool rcl_action_server_is_valid_except_context(const rcl_action_server_t * action_server);

/* Returns the expanded name of the action, "/arm/fibonacci", which is constant; NULL, with a text, if it is not open. */
const char * rcl_action_server_get_action_name(const rcl_action_server_t * action_server);

/*
 * Sets *goal_handles to an array of pointers to the goals of the server, and *num_goals to their number: those that were
 * accepted and whose results have not expired. The array belongs to the library; the next call for this server writes it
 * again. May be called by any task, for each server by one at a time. RCL_RET_ACTION_SERVER_INVALID or
 * RCL_RET_INVALID_ARGUMENT, with a text.
 */
rcl_ret_t rcl_action_server_get_goal_handles(
  const rcl_action_server_t * action_server, rcl_action_goal_handle_t *** goal_handles, size_t * num_goals);

/*
 * Fills a zero-initialized list with the states of those goals, in memory of the default allocator: the application file
 * needs `memory: {arena: N}`, and rcl_action_goal_status_array_fini frees it. RCL_RET_ACTION_SERVER_INVALID,
 * RCL_RET_INVALID_ARGUMENT for NULL or a list with memory, RCL_RET_BAD_ALLOC.
 */
rcl_ret_t rcl_action_get_goal_status_array(
  const rcl_action_server_t * action_server, rcl_action_goal_status_array_t * status_message);

/*
 * Publishes a <pkg>__action__<Type>_FeedbackMessage whose `goal_id` the caller has set, where rclc_action_publish_feedback
 * sets it. Codes as of rcl_publish, and RCL_RET_ACTION_SERVER_INVALID or RCL_RET_INVALID_ARGUMENT.
 */
rcl_ret_t rcl_action_publish_feedback(const rcl_action_server_t * action_server, void * ros_feedback);

/* Publishes an action_msgs__msg__GoalStatusArray; the executor publishes each change by itself. Codes as above. */
rcl_ret_t rcl_action_publish_status(const rcl_action_server_t * action_server, const void * status_message);

/*
 * Frees the places of goals whose `result_timeout` is over, as the executor does in each round. Copies the ids and times of at
 * most `expired_goals_capacity` of them, which are then all that it frees; all three arguments are NULL or 0, or none
 * is. RCL_RET_ACTION_SERVER_INVALID or RCL_RET_INVALID_ARGUMENT, with a text. May be called by any task.
 */
rcl_ret_t rcl_action_expire_goals(
  const rcl_action_server_t * action_server, rcl_action_goal_info_t * expired_goals,
  size_t expired_goals_capacity, size_t * num_expired);

/*
 * Returns whether the server has a goal with the id in `goal_info`, until the time of its result has expired. False, with a
 * text, for NULL and a server that is not open. May be called by any task.
 */
bool rcl_action_server_goal_exists(
  const rcl_action_server_t * action_server, const rcl_action_goal_info_t * goal_info);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_ACTION_SERVER_H */
