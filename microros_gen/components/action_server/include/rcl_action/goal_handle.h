/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goals of an action server below rclc: what rcl_action_server_get_goal_handles lists. They are for reading; rclc changes
 * the states (rclc/action_server.h). All functions may be called by any task.
 */
#ifndef MICROROS_RCL_ACTION_GOAL_HANDLE_H
#define MICROROS_RCL_ACTION_GOAL_HANDLE_H

#include <stdbool.h>

#include "rcl/macros.h"
#include "rcl_action/goal_state_machine.h"
#include "rcl_action/types.h"
#include "rcl_action/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A goal of rclc. */
typedef struct rclc_action_goal_handle_t rcl_action_goal_handle_impl_t;

/* Valid until the result of the goal has expired or another goal has its place. */
typedef struct rcl_action_goal_handle_s {
  const rcl_action_goal_handle_impl_t * impl;
} rcl_action_goal_handle_t;

rcl_action_goal_handle_t rcl_action_get_zero_initialized_goal_handle(void);

/* Returns whether there is a goal; false, with a text, for NULL and for one whose place is free. */
bool rcl_action_goal_handle_is_valid(const rcl_action_goal_handle_t * goal_handle);

/* Copies the id of the goal and the time of its acceptance. RCL_RET_ACTION_GOAL_HANDLE_INVALID, with a text, where
 * rcl_action_goal_handle_is_valid is false; RCL_RET_INVALID_ARGUMENT for NULL. */
rcl_ret_t rcl_action_goal_handle_get_info(
  const rcl_action_goal_handle_t * goal_handle, rcl_action_goal_info_t * goal_info);

/* Sets *status to the state of the goal; codes as above. */
rcl_ret_t rcl_action_goal_handle_get_status(
  const rcl_action_goal_handle_t * goal_handle, rcl_action_goal_state_t * status);

/* Return whether the goal has not ended, and whether it can still be canceled; false for an invalid handle. */
bool rcl_action_goal_handle_is_active(const rcl_action_goal_handle_t * goal_handle);
bool rcl_action_goal_handle_is_cancelable(const rcl_action_goal_handle_t * goal_handle);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_GOAL_HANDLE_H */
