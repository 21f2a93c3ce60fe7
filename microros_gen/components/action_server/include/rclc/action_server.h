/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Action servers. The executor calls the callbacks; the application executes the goal where it likes (a timer, another
 * task with `multithread`), publishes feedback, and ends the goal with rclc_action_send_result. The memory of goals and
 * results is planned from the node's `actions:`, nothing allocates.
 */
#ifndef MICROROS_RCLC_ACTION_SERVER_H
#define MICROROS_RCLC_ACTION_SERVER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcl/node.h"
#include "rcl_action/action_server.h"
#include "rclc/action_goal_handle.h"
#include "rclc/executor.h"
#include "rclc/init.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The goal is still in its callback, which has not accepted it yet: call again later. */
#define RCLC_RET_ACTION_WAIT_RESULT_REQUEST 2104

/*
 * Called for each new goal. RCL_RET_ACTION_GOAL_ACCEPTED: it is executed from now on, and the handle stays valid until
 * rclc_action_send_result has returned RCL_RET_OK. Anything else rejects it, and the handle is invalid.
 */
typedef rcl_ret_t (*rclc_action_server_handle_goal_callback_t)(
  rclc_action_goal_handle_t * goal_handle, void * context);

/*
 * Called for each goal that a client asks to cancel. True: the goal is canceling; the application ends it soon, usually
 * as GOAL_STATE_CANCELED. False: it goes on.
 */
typedef bool (*rclc_action_server_handle_cancel_callback_t)(
  rclc_action_goal_handle_t * goal_handle, void * context);

struct rclc_action_declared_t; /* microros/rclc_action_server.h */

/* Stays where it is while it is open. The application uses `rcl_handle`, and reads `refused_goals`. */
typedef struct rclc_action_server_t {
  const struct rclc_action_declared_t * declared; /* NULL: not open */
  const void * type;                              /* microros_action_type_t */
  rcl_action_server_t rcl_handle;
  rclc_action_server_handle_goal_callback_t goal_callback;
  rclc_action_server_handle_cancel_callback_t cancel_callback;
  void * context;
  size_t goal_handles_memory_size; /* places of goals that are looked at; 0: no executor runs it */
  uint32_t refused_goals;          /* without their callback: no place, an id in use, or above a limit */
  uint16_t goals_at_once;          /* places for new goals, the first ones */
  uint8_t session;
  bool status_due;
} rclc_action_server_t;

/*
 * Opens the three services and two topics of an action that is declared in the node's `actions:`; each waits for the
 * agent, at most MICROROS_CREATE_TIMEOUT_MS. The codes are those of rcl_service_init and rcl_publisher_init; on an error
 * everything is closed again.
 */
rcl_ret_t rclc_action_server_init_default(
  rclc_action_server_t * action_server, rcl_node_t * node, rclc_support_t * support,
  const rosidl_action_type_support_t * type_support, const char * action_name);

/* Closes them. Its goals end without a result. Finalize the executor, or remove the server from it, before. */
rcl_ret_t rclc_action_server_fini(rclc_action_server_t * action_server, rcl_node_t * node);

/*
 * Ends a goal. `status` is GOAL_STATE_SUCCEEDED, GOAL_STATE_ABORTED or, after a cancel request was accepted,
 * GOAL_STATE_CANCELED; `ros_response` is a <pkg>__action__<Type>_GetResult_Response, whose `status` is set here. It is
 * encoded at once, and the executor sends it to everybody who asks, now or within `result_timeout`. May be called by
 * any task, and with or without the agent. RCL_RET_OK: the handle is no longer valid.
 * RCLC_RET_ACTION_WAIT_RESULT_REQUEST: as above. RCL_RET_INVALID_ARGUMENT for NULL, for a goal that has ended, and for
 * a status that is no end; RCL_RET_ACTION_GOAL_EVENT_INVALID for GOAL_STATE_CANCELED without a cancel request;
 * RCL_RET_ERROR, with a text, if the result is above its limits. The goal goes on then.
 */
rcl_ret_t rclc_action_send_result(
  rclc_action_goal_handle_t * goal_handle, rcl_action_goal_state_t status, void * ros_response);

/*
 * Publishes a <pkg>__action__<Type>_FeedbackMessage, whose `goal_id` is set here. Codes as of rcl_publish;
 * RCL_RET_INVALID_ARGUMENT for NULL and for a goal that has ended.
 */
rcl_ret_t rclc_action_publish_feedback(rclc_action_goal_handle_t * goal_handle, void * ros_feedback);

/*
 * Adds an open server; takes one handle. `handles_number` goals at once, at most the declared ones; `ros_goal_request`
 * is an array of so many <pkg>__action__<Type>_SendGoal_Request of `ros_goal_request_size` bytes, which stays where it is.
 * Strings and sequences without buffers get storage of the library. The goal callback runs for one request in each
 * round. A goal that has no place, has the id of another one, or is above the limits is rejected, counted in
 * `refused_goals`, and the round returns RCL_RET_ERROR with a text. RCL_RET_INVALID_ARGUMENT for NULL,
 * otherwise RCL_RET_ERROR with a text.
 */
rcl_ret_t rclc_executor_add_action_server(
  rclc_executor_t * executor, rclc_action_server_t * action_server, size_t handles_number,
  void * ros_goal_request, size_t ros_goal_request_size,
  rclc_action_server_handle_goal_callback_t goal_callback,
  rclc_action_server_handle_cancel_callback_t cancel_callback, void * context);

/* Removes it; its goals stay, and requests wait until it is added again. */
rcl_ret_t rclc_executor_remove_action_server(
  rclc_executor_t * executor, rclc_action_server_t * action_server);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_ACTION_SERVER_H */
