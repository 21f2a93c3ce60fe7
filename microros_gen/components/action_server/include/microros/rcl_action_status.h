/* SPDX-License-Identifier: Apache-2.0 */
/* The messages with states of goals, which a server publishes. */
#ifndef MICROROS_RCL_ACTION_STATUS_H
#define MICROROS_RCL_ACTION_STATUS_H

#include <stddef.h>

#include "action_msgs/msg/goal_status.h"
#include "action_msgs/msg/goal_status_array.h"
#include "rcl/allocator.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef action_msgs__msg__GoalStatus rcl_action_goal_status_t;

/* States of goals, and the allocator of the list. */
typedef struct rcl_action_goal_status_array_s {
  action_msgs__msg__GoalStatusArray msg;
  rcl_allocator_t allocator;
} rcl_action_goal_status_array_t;

rcl_action_goal_status_array_t rcl_action_get_zero_initialized_goal_status_array(void);

/*
 * Gives a zero-initialized list memory of the allocator for `num_status` goals; rcl_action_goal_status_array_fini frees
 * it. RCL_RET_INVALID_ARGUMENT for NULL, for an invalid allocator and for no goals; RCL_RET_ALREADY_INIT; RCL_RET_BAD_ALLOC if
 * the allocator has no memory: for the default one `memory: {arena: N}` of the application file.
 */
rcl_ret_t rcl_action_goal_status_array_init(
  rcl_action_goal_status_array_t * status_array, const size_t num_status, const rcl_allocator_t allocator);

/* Also for one that is zero-initialized. RCL_RET_INVALID_ARGUMENT for NULL. */
rcl_ret_t rcl_action_goal_status_array_fini(rcl_action_goal_status_array_t * status_array);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_STATUS_H */
