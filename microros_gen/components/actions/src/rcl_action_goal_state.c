/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_action/goal_state_machine.h"

static rcl_action_goal_state_t goal_state_of_active(
  rcl_action_goal_event_t event, rcl_action_goal_state_t canceling, rcl_action_goal_state_t canceled)
{
  switch (event) {
    case GOAL_EVENT_SUCCEED:
      return GOAL_STATE_SUCCEEDED;
    case GOAL_EVENT_ABORT:
      return GOAL_STATE_ABORTED;
    case GOAL_EVENT_CANCEL_GOAL:
      return canceling;
    case GOAL_EVENT_CANCELED:
      return canceled;
    case GOAL_EVENT_EXECUTE:
    case GOAL_EVENT_NUM_EVENTS:
    default:
      return GOAL_STATE_UNKNOWN;
  }
}

rcl_action_goal_state_t rcl_action_transition_goal_state(
  const rcl_action_goal_state_t state, const rcl_action_goal_event_t event)
{
  switch (state) {
    case GOAL_STATE_ACCEPTED:
      if (event == GOAL_EVENT_EXECUTE) {
        return GOAL_STATE_EXECUTING;
      }
      return event == GOAL_EVENT_CANCEL_GOAL ? GOAL_STATE_CANCELING : GOAL_STATE_UNKNOWN;
    case GOAL_STATE_EXECUTING:
      return goal_state_of_active(event, GOAL_STATE_CANCELING, GOAL_STATE_UNKNOWN);
    case GOAL_STATE_CANCELING:
      return goal_state_of_active(event, GOAL_STATE_UNKNOWN, GOAL_STATE_CANCELED);
    default:
      return GOAL_STATE_UNKNOWN;
  }
}
