/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The state machine of a node with a life cycle, below rclc_lifecycle/rclc_lifecycle.h. None of these functions
 * allocates; a state machine belongs to one task, that of the executor.
 */
#ifndef MICROROS_RCL_LIFECYCLE_RCL_LIFECYCLE_H
#define MICROROS_RCL_LIFECYCLE_RCL_LIFECYCLE_H

#include <stdbool.h>
#include <stdint.h>

#include "rcl/types.h"
#include "rcl_lifecycle/data_types.h"
#include "rcl_lifecycle/default_state_machine.h"
#include "rcl_lifecycle/visibility_control.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns options with the default states and the services. */
rcl_lifecycle_state_machine_options_t rcl_lifecycle_get_default_state_machine_options(void);

/* Returns a state machine without a state. */
rcl_lifecycle_state_machine_t rcl_lifecycle_get_zero_initialized_state_machine(void);

/*
 * Opens the publisher of ~/transition_event and, with options->enable_com_interface, the five services; each waits for
 * the agent, at most MICROROS_CREATE_TIMEOUT_MS. The state is `unconfigured`, or after a sleep the one before it.
 * The machine must stay where it is until rcl_lifecycle_state_machine_fini. ~/get_available_transitions and
 * ~/get_transition_graph are answered by the library whenever an executor or rcl_wait receives, with its own types
 * (`ts_srv_get_available_transitions` and `ts_srv_get_transition_graph` are not used). RCL_RET_UNSUPPORTED: states other
 * than the default ones; otherwise the codes of rcl_publisher_init and rcl_service_init, with nothing left open.
 */
rcl_ret_t rcl_lifecycle_state_machine_init(
  rcl_lifecycle_state_machine_t * state_machine, rcl_node_t * node_handle,
  const rosidl_message_type_support_t * ts_pub_notify,
  const rosidl_service_type_support_t * ts_srv_change_state,
  const rosidl_service_type_support_t * ts_srv_get_state,
  const rosidl_service_type_support_t * ts_srv_get_available_states,
  const rosidl_service_type_support_t * ts_srv_get_available_transitions,
  const rosidl_service_type_support_t * ts_srv_get_transition_graph,
  const rcl_lifecycle_state_machine_options_t * state_machine_options);

/* Closes what rcl_lifecycle_state_machine_init opened. Returns the first error. */
rcl_ret_t rcl_lifecycle_state_machine_fini(
  rcl_lifecycle_state_machine_t * state_machine, rcl_node_t * node_handle);

/* RCL_RET_INVALID_ARGUMENT, with a text: NULL, or not initialized. */
rcl_ret_t rcl_lifecycle_state_machine_is_initialized(const rcl_lifecycle_state_machine_t * state_machine);

/* Return a transition that begins in the state, or NULL. */
const rcl_lifecycle_transition_t * rcl_lifecycle_get_transition_by_id(
  const rcl_lifecycle_state_t * state, uint8_t id);
const rcl_lifecycle_transition_t * rcl_lifecycle_get_transition_by_label(
  const rcl_lifecycle_state_t * state, const char * label);

/*
 * Goes through one transition, without callbacks. RCL_RET_INVALID_ARGUMENT, with a text: it does not begin in the
 * current state, which stays. Up to eight events wait for room in the stream; then the oldest is dropped and counted.
 * The state changes all the same.
 */
rcl_ret_t rcl_lifecycle_trigger_transition_by_id(
  rcl_lifecycle_state_machine_t * state_machine, uint8_t id, bool publish_notification);
rcl_ret_t rcl_lifecycle_trigger_transition_by_label(
  rcl_lifecycle_state_machine_t * state_machine, const char * label, bool publish_notification);

/* Logs all states and their transitions; nothing without `logging:`. */
void rcl_print_state_machine(const rcl_lifecycle_state_machine_t * state_machine);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_RCL_LIFECYCLE_H */
