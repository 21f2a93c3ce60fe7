/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with a life cycle (ROS 2 calls it a managed node): other nodes configure, activate, deactivate and shut it
 * down by services, and the application does so by rclc_lifecycle_change_state.
 *
 * A callback is called in the state of its transition ("configuring"). It returns RCL_RET_OK for success;
 * lifecycle_msgs__msg__Transition__TRANSITION_CALLBACK_ERROR for an error, which leads to "errorprocessing"; anything
 * else is a failure, which leads back. A transition without a callback succeeds. All functions are called by one task,
 * that of the executor, and none allocates.
 */
#ifndef MICROROS_RCLC_LIFECYCLE_RCLC_LIFECYCLE_H
#define MICROROS_RCLC_LIFECYCLE_RCLC_LIFECYCLE_H

#include <stdbool.h>

#include "lifecycle_msgs/msg/state.h"
#include "lifecycle_msgs/msg/transition.h"
#include "lifecycle_msgs/srv/change_state.h"
#include "lifecycle_msgs/srv/get_available_states.h"
#include "lifecycle_msgs/srv/get_state.h"
#include "rcl/error_handling.h"
#include "rcl_lifecycle/rcl_lifecycle.h"
#include "rclc/executor.h"
#include "rclc/node.h"
#include "rclc_lifecycle/visibility_control.h"
#include "rcutils/logging_macros.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Callbacks have the ids of requested transitions (1 to 7) and of the state "errorprocessing" (15). */
#define RCLC_LIFECYCLE_MAX_NUMBER_OF_STATES 16

/* Bytes of the label in a request, with its NUL; a longer one is no transition. */
#define RCLC_LIFECYCLE_MAX_STRING_LENGTH 20

typedef struct rclc_lifecycle_callback_map_t {
  bool goal_states[RCLC_LIFECYCLE_MAX_NUMBER_OF_STATES];
  int (*fun_ptrs[RCLC_LIFECYCLE_MAX_NUMBER_OF_STATES])(void);
} rclc_lifecycle_callback_map_t;

typedef struct rclc_lifecycle_node_t {
  rcl_node_t * node;
  rcl_lifecycle_state_machine_t * state_machine;
  rclc_lifecycle_callback_map_t callbacks;
  bool publish_transitions;

  lifecycle_msgs__srv__ChangeState_Request cs_req;
  lifecycle_msgs__srv__ChangeState_Response cs_res;
  lifecycle_msgs__srv__GetState_Request gs_req;
  lifecycle_msgs__srv__GetState_Response gs_res;
  lifecycle_msgs__srv__GetAvailableStates_Request gas_req;
  lifecycle_msgs__srv__GetAvailableStates_Response gas_res;

  char label[RCLC_LIFECYCLE_MAX_STRING_LENGTH]; /* of cs_req */
} rclc_lifecycle_node_t;

/* What the services pass to their callbacks. */
typedef struct rclc_lifecycle_service_context_t {
  rclc_lifecycle_node_t * lifecycle_node;
} rclc_lifecycle_service_context_t;

/*
 * Gives an open node a life cycle: the state is `unconfigured`, or after a sleep the one before it
 * (state_machine->current_state). Opens the publisher of ~/transition_event and, with
 * `enable_communication_interface`, five services; each waits for the agent, at most MICROROS_CREATE_TIMEOUT_MS. Of
 * these the application adds the three below to its executor; the library answers ~/get_available_transitions and
 * ~/get_transition_graph by itself whenever an executor spins. The three structs belong to the application and stay
 * where they are. The allocator is not called. RCL_RET_INVALID_ARGUMENT for NULL; otherwise the codes of
 * rcl_publisher_init and rcl_service_init.
 */
rcl_ret_t rclc_make_node_a_lifecycle_node(
  rclc_lifecycle_node_t * lifecycle_node, rcl_node_t * node, rcl_lifecycle_state_machine_t * state_machine,
  rcl_allocator_t * allocator, bool enable_communication_interface);

/* Closes publisher and services; the node stays open. Remove the services from the executor before. */
rcl_ret_t rclc_lifecycle_node_fini(rclc_lifecycle_node_t * node, rcl_allocator_t * allocator);

/* Add a service to the executor; `context` and its node stay where they are. Each takes one handle. */
rcl_ret_t rclc_lifecycle_init_get_state_server(
  rclc_lifecycle_service_context_t * context, rclc_executor_t * executor);
rcl_ret_t rclc_lifecycle_init_get_available_states_server(
  rclc_lifecycle_service_context_t * context, rclc_executor_t * executor);
rcl_ret_t rclc_lifecycle_init_change_state_server(
  rclc_lifecycle_service_context_t * context, rclc_executor_t * executor);

/* The callbacks of these services: `req` and `res` are their messages, `context` is their context. A request to change
 * the state names a transition by its label or, with an empty label, by its id. The response is true if the callback
 * succeeded; if the transition does not begin in the current state it is false, and the state stays. */
void rclc_lifecycle_get_state_callback(const void * req, void * res, void * context);
void rclc_lifecycle_get_available_states_callback(const void * req, void * res, void * context);
void rclc_lifecycle_change_state_callback(const void * req, void * res, void * context);

/*
 * Requests a transition, calls its callback, and goes on to the state that follows from what it returns. RCL_RET_OK
 * also if the callback failed: state_machine->current_state tells. RCL_RET_ERROR, with a text: the transition does not
 * begin in the current state, which stays. `publish_update`: send events to ~/transition_event; without room or
 * without the agent up to eight wait, then the oldest is dropped and counted.
 */
rcl_ret_t rclc_lifecycle_change_state(
  rclc_lifecycle_node_t * lifecycle_node, unsigned int transition_id, bool publish_update);

/* Registers a callback for one of lifecycle_msgs__msg__Transition__TRANSITION_..., 1 to 7, which replaces the former
 * one; with lifecycle_msgs__msg__State__TRANSITION_STATE_ERRORPROCESSING that of an error. Each of the three states
 * that can be left by a shutdown has its own transition. RCL_RET_INVALID_ARGUMENT: another id, or NULL. */
rcl_ret_t rclc_lifecycle_register_callback(
  rclc_lifecycle_node_t * lifecycle_node, unsigned int goal_state, int (*cb)(void));

rcl_ret_t rclc_lifecycle_register_on_configure(rclc_lifecycle_node_t * node, int (*cb)(void));
rcl_ret_t rclc_lifecycle_register_on_activate(rclc_lifecycle_node_t * node, int (*cb)(void));
rcl_ret_t rclc_lifecycle_register_on_deactivate(rclc_lifecycle_node_t * node, int (*cb)(void));
rcl_ret_t rclc_lifecycle_register_on_cleanup(rclc_lifecycle_node_t * node, int (*cb)(void));

/* Calls the callback of a transition and returns its result; RCL_RET_OK without one. The state stays. */
rcl_ret_t rclc_lifecycle_execute_callback(rclc_lifecycle_node_t * lifecycle_node, unsigned int transition_id);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_LIFECYCLE_RCLC_LIFECYCLE_H */
