/* SPDX-License-Identifier: Apache-2.0 */
/* A requested transition, and the type of the service that requests it. Internal. */
#ifndef MICROROS_RCLC_LIFECYCLE_CHANGE_H
#define MICROROS_RCLC_LIFECYCLE_CHANGE_H

#include "rclc_lifecycle/rclc_lifecycle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the callback of a transition returned; the first three are positions of the transitions that follow. */
typedef enum lifecycle_outcome_t {
  LIFECYCLE_SUCCESS,
  LIFECYCLE_FAILURE,
  LIFECYCLE_ERROR,
  LIFECYCLE_REFUSED /* the transition does not begin in the current state; the error text is set */
} lifecycle_outcome_t;

/* As rclc_lifecycle_change_state, of a node that has a state. */
lifecycle_outcome_t rclc_lifecycle_change(
  rclc_lifecycle_node_t * lifecycle_node, unsigned int transition_id, bool publish_update);

/* lifecycle_msgs/srv/ChangeState, with labels of any length: one that is too long is that of no transition. */
extern const rosidl_service_type_support_t rclc_lifecycle_change_type;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_LIFECYCLE_CHANGE_H */
