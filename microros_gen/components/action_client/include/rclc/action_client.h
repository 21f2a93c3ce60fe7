/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Action clients. The application sends a goal and gets its acceptance, feedback and result by callbacks of the executor.
 * The memory of goals is planned from the node's `action_clients:`, nothing allocates.
 */
#ifndef MICROROS_RCLC_ACTION_CLIENT_H
#define MICROROS_RCLC_ACTION_CLIENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/service_type.h"
#include "rcl/node.h"
#include "rcl_action/action_client.h"
#include "rclc/action_goal_handle.h"
#include "rclc/executor.h"
#include "rclc/init.h"
#include "rclc/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Called once for each goal that was sent: accepted by the server, or not. Not accepted is also a goal without a response
 * within `response_timeout`, or of a lost session; a response that comes later is discarded. The handle of a goal that
 * was not accepted is invalid when the callback has returned. The result of an accepted one is asked for afterwards.
 */
typedef void (*rclc_action_client_goal_callback_t)(
  rclc_action_goal_handle_t * goal_handle, bool accepted, void * context);

/* Called for each feedback of a goal of this client; `ros_feedback` is the message given to the executor. */
typedef void (*rclc_action_client_feedback_callback_t)(
  rclc_action_goal_handle_t * goal_handle, void * ros_feedback, void * context);

/*
 * Called once for each accepted goal; the handle is invalid when it has returned. `ros_result_response` is the message
 * given to the executor, whose `status` says how the goal ended. GOAL_STATE_UNKNOWN, and the other members as they were:
 * the server does not know the goal, or `result_timeout` is over.
 */
typedef void (*rclc_action_client_result_callback_t)(
  rclc_action_goal_handle_t * goal_handle, void * ros_result_response, void * context);

/*
 * Called once for the last cancel request of a goal, unless its result comes before. `canceled`: the server will end the
 * goal, whose result follows; otherwise the goal goes on, is unknown, or there was no response within `response_timeout`.
 */
typedef void (*rclc_action_client_cancel_callback_t)(
  rclc_action_goal_handle_t * goal_handle, bool canceled, void * context);

struct rclc_action_client_declared_t; /* microros/rclc_action_client.h */

/* Stays where it is while it is open. The application uses `rcl_handle` alone. */
typedef struct rclc_action_client_t {
  rcl_action_client_t rcl_handle;
  const struct rclc_action_client_declared_t * declared; /* NULL: not open */
  rclc_action_client_goal_callback_t goal_callback;
  rclc_action_client_feedback_callback_t feedback_callback;
  rclc_action_client_result_callback_t result_callback;
  rclc_action_client_cancel_callback_t cancel_callback;
  void * context;
  void * ros_feedback;
  void * ros_result_response;
  microros_service_type_t goal_type;
  microros_service_type_t result_type;
  size_t goal_handles_memory_size; /* places of goals that are looked at; 0: no executor runs it */
  rcl_ret_t fault;                 /* first one of the round */
  uint32_t drops;
  uint16_t goals_at_once; /* places for new goals, the first ones */
  uint8_t session;
} rclc_action_client_t;

/*
 * Opens the three clients and the subscription of an action that is declared in the node's `action_clients:`; each waits
 * for the agent, at most MICROROS_CREATE_TIMEOUT_MS. The codes are those of rcl_client_init and rcl_subscription_init; on
 * an error everything is closed again.
 */
rcl_ret_t rclc_action_client_init_default(
  rclc_action_client_t * action_client, rcl_node_t * node, const rosidl_action_type_support_t * type_support,
  const char * action_name);

/*
 * Sends a goal. `ros_request` is a <pkg>__action__<Type>_SendGoal_Request, whose `goal_id` is set here; the library keeps
 * only its address, as `ros_goal_request` of the handle. `goal_handle` may be NULL. Does not wait for the server; may be
 * called in callbacks, and by any task with `multithread`. RCL_RET_INVALID_ARGUMENT for NULL; RCL_RET_ERROR, with a text,
 * if all goals are in use, no executor runs the client, a field is above its limit, the stream is full, or the session
 * is not open.
 */
rcl_ret_t rclc_action_send_goal_request(
  rclc_action_client_t * action_client, void * ros_request, rclc_action_goal_handle_t ** goal_handle);

/*
 * Asks the server for the result of a goal. The executor calls it when the goal was accepted, and again after each new
 * session: no application needs to. Codes as of rcl_send_request; RCL_RET_INVALID_ARGUMENT for NULL and an invalid handle.
 */
rcl_ret_t rclc_action_send_result_request(rclc_action_goal_handle_t * goal_handle);

/* Asks the server to cancel a goal. A further request replaces one without a response. Codes as above. */
rcl_ret_t rclc_action_send_cancel_request(rclc_action_goal_handle_t * goal_handle);

/*
 * Closes what is open. Its goals go on at the server, without callbacks here. Finalize the executor, or remove the client
 * from it, before.
 */
rcl_ret_t rclc_action_client_fini(rclc_action_client_t * action_client, rcl_node_t * node);

/*
 * Adds an open client; takes one handle. `handles_number` goals at once, at most the declared ones: more are
 * RCL_RET_ERROR with a text. Strings and sequences without buffers of `ros_result_response` and `ros_feedback` get
 * storage of the library; both stay where they are. In one round at most one message of each sort is taken, and the
 * callbacks run in the order goal, feedback, cancel, result. feedback_callback and cancel_callback may be NULL, and
 * ros_feedback then, too. RCL_RET_INVALID_ARGUMENT for other NULL and for 0 goals.
 */
rcl_ret_t rclc_executor_add_action_client(
  rclc_executor_t * executor, rclc_action_client_t * action_client, size_t handles_number,
  void * ros_result_response, void * ros_feedback, rclc_action_client_goal_callback_t goal_callback,
  rclc_action_client_feedback_callback_t feedback_callback,
  rclc_action_client_result_callback_t result_callback, rclc_action_client_cancel_callback_t cancel_callback,
  void * context);

/* Removes it; its goals stay, and responses wait until it is added again, be it with fewer goals at once. */
rcl_ret_t rclc_executor_remove_action_client(
  rclc_executor_t * executor, rclc_action_client_t * action_client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_ACTION_CLIENT_H */
