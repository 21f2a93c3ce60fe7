/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rclc_modes_table.h"

/* Requests a transition; returns whether the node is in that state then. */
static bool modes_go(const rclc_modes_t * modes, unsigned int transition, uint8_t state)
{
  rclc_lifecycle_node_t * node = modes->lifecycle_node;

  (void)rclc_lifecycle_change_state(node, transition, node->publish_transitions);
  return rclc_modes_state(modes) == state;
}

static bool modes_activate(const rclc_modes_t * modes)
{
  return modes_go(
    modes, lifecycle_msgs__msg__Transition__TRANSITION_ACTIVATE,
    (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_ACTIVE);
}

static rcl_ret_t modes_refuse_transition(const rclc_modes_t * modes, uint8_t mode)
{
  return rclc_modes_refuse(
    RCL_RET_ERROR, rclc_modes_name(modes, mode), MICROROS_ERROR_WORDS("a transition of the node failed"));
}

/* For a node that did not become active in the new mode: back to the former one, and once more. */
static rcl_ret_t modes_return(rclc_modes_t * modes, uint8_t mode, uint8_t former_mode)
{
  if (rclc_modes_switch(modes, former_mode, false) == RCL_RET_OK) {
    (void)modes_activate(modes);
  }
  return modes_refuse_transition(modes, mode);
}

/* For a node that was active and is inactive now. */
static rcl_ret_t modes_reconfigure(rclc_modes_t * modes, uint8_t mode)
{
  const uint8_t former_mode = modes->mode;
  const rcl_ret_t result = rclc_modes_switch(modes, mode, true);

  if (result != RCL_RET_OK) {
    (void)modes_activate(modes); /* the refusal is reported */
    return result;
  }
  if (!modes_activate(modes)) {
    return modes_return(modes, mode, former_mode);
  }
  rclc_modes_notify(modes, former_mode);
  return RCL_RET_OK;
}

rcl_ret_t rclc_modes_reconfigure(rclc_modes_t * modes, uint8_t mode)
{
  const rcl_ret_t result = rclc_modes_may_change(modes, mode);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (rclc_modes_state(modes) == (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_INACTIVE) {
    return rclc_modes_change(modes, mode);
  }
  if (!modes_go(
        modes, lifecycle_msgs__msg__Transition__TRANSITION_DEACTIVATE,
        (uint8_t)lifecycle_msgs__msg__State__PRIMARY_STATE_INACTIVE)) {
    return modes_refuse_transition(modes, mode);
  }
  return modes_reconfigure(modes, mode);
}
