/* SPDX-License-Identifier: Apache-2.0 */
/* The state machine of a node with a life cycle. Its states and transitions are constants: all nodes share them. */
#ifndef MICROROS_RCL_LIFECYCLE_DATA_TYPES_H
#define MICROROS_RCL_LIFECYCLE_DATA_TYPES_H

#include <stdbool.h>
#include <stdint.h>

#include "lifecycle_msgs/msg/transition_event.h"
#include "rcl/allocator.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/service.h"
#include "rcl_lifecycle/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_lifecycle_transition_s rcl_lifecycle_transition_t;

/* A state and the transitions that begin there. */
typedef struct rcl_lifecycle_state_s {
  const char * label; /* "unconfigured", "inactive", ... */
  uint8_t id;         /* lifecycle_msgs__msg__State__... */
  const rcl_lifecycle_transition_t * valid_transitions;
  unsigned int valid_transition_size;
} rcl_lifecycle_state_t;

struct rcl_lifecycle_transition_s {
  const char * label; /* "configure", "transition_success", ... */
  unsigned int id;    /* lifecycle_msgs__msg__Transition__... */
  const rcl_lifecycle_state_t * start;
  const rcl_lifecycle_state_t * goal;
};

typedef struct rcl_lifecycle_transition_map_s {
  const rcl_lifecycle_state_t * states;
  unsigned int states_size;
  const rcl_lifecycle_transition_t * transitions;
  unsigned int transitions_size;
} rcl_lifecycle_transition_map_t;

/* What a node with a life cycle has in the ROS graph. */
typedef struct rcl_lifecycle_com_interface_s {
  rcl_node_t * node_handle;
  rcl_publisher_t pub_transition_event;
  rcl_service_t srv_change_state;
  rcl_service_t srv_get_state;
  rcl_service_t srv_get_available_states;
  rcl_service_t srv_get_available_transitions;
  rcl_service_t srv_get_transition_graph;
  lifecycle_msgs__msg__TransitionEvent msg; /* the last one that was published */
} rcl_lifecycle_com_interface_t;

typedef struct rcl_lifecycle_state_machine_options_s {
  bool initialize_default_states; /* must be true: there are no others */
  bool enable_com_interface;      /* whether the node has the services; the publisher exists in any case */
  rcl_allocator_t allocator;      /* never called */
} rcl_lifecycle_state_machine_options_t;

typedef struct rcl_lifecycle_state_machine_s {
  const rcl_lifecycle_state_t * current_state;
  rcl_lifecycle_transition_map_t transition_map;
  rcl_lifecycle_com_interface_t com_interface;
  rcl_lifecycle_state_machine_options_t options;
} rcl_lifecycle_state_machine_t;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_DATA_TYPES_H */
