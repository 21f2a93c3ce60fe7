/* SPDX-License-Identifier: Apache-2.0 */
/* States of a goal (design.ros2.org, "Actions"). */
#ifndef MICROROS_RCL_ACTION_GOAL_STATE_MACHINE_H
#define MICROROS_RCL_ACTION_GOAL_STATE_MACHINE_H

#include "rcl_action/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the state after an event; GOAL_STATE_UNKNOWN if the event is impossible in this state. */
rcl_action_goal_state_t rcl_action_transition_goal_state(
  const rcl_action_goal_state_t state, const rcl_action_goal_event_t event);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_GOAL_STATE_MACHINE_H */
