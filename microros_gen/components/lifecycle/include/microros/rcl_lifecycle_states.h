/* SPDX-License-Identifier: Apache-2.0 */
/* The states and transitions of ROS 2, and the same states as messages. Internal. */
#ifndef MICROROS_RCL_LIFECYCLE_STATES_H
#define MICROROS_RCL_LIFECYCLE_STATES_H

#include <stdint.h>

#include "lifecycle_msgs/msg/state.h"
#include "rcl_lifecycle/data_types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { RCL_LIFECYCLE_STATES = 11, RCL_LIFECYCLE_TRANSITIONS = 25 };

/* States are in the order of ROS 2. The transitions that leave a state follow each other, in the order of ROS 2; of
 * the transition states: success, failure, error. */
extern const rcl_lifecycle_state_t rcl_lifecycle_states[RCL_LIFECYCLE_STATES];
extern const rcl_lifecycle_transition_t rcl_lifecycle_transitions[RCL_LIFECYCLE_TRANSITIONS];

/* Positions in rcl_lifecycle_transitions, in the order in which ROS 2 shows the graph. */
extern const uint8_t rcl_lifecycle_graph[RCL_LIFECYCLE_TRANSITIONS];

/* Returns a state as a message, whose text is a constant. */
lifecycle_msgs__msg__State rcl_lifecycle_message_of(const rcl_lifecycle_state_t * state);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_STATES_H */
