/* SPDX-License-Identifier: Apache-2.0 */
/* The message of a goal's state, which a server publishes. */
#ifndef MICROROS_RCL_ACTION_STATUS_H
#define MICROROS_RCL_ACTION_STATUS_H

#include "action_msgs/msg/goal_status.h"

typedef action_msgs__msg__GoalStatus rcl_action_goal_status_t;

#endif /* MICROROS_RCL_ACTION_STATUS_H */
