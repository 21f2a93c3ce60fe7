/* SPDX-License-Identifier: Apache-2.0 */
/* Calls of rclc's actions in every state that needs no other side: compiled once against ros2/rclc over librcl_action,
 * whose answers are in actions_rclc.txt, and against the generated library. */
#include "tell.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <string.h>

#ifdef MICROROS_RCL_ACTION_TYPES_H
#include <example_interfaces/action/fibonacci.h>
#define FIBONACCI(name) example_interfaces__action__Fibonacci_##name
#define FIBONACCI_TYPE ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci)
#else /* what the wheels have */
#include <test_msgs/action/fibonacci.h>
#define FIBONACCI(name) test_msgs__action__Fibonacci_##name
#define FIBONACCI_TYPE ROSIDL_GET_ACTION_TYPE_SUPPORT(test_msgs, Fibonacci)
#endif

enum { GOALS = 2 };

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_action_server_t server;
static rclc_action_client_t client;
static FIBONACCI(SendGoal_Request) requests[GOALS];
static FIBONACCI(SendGoal_Request) request;
static FIBONACCI(FeedbackMessage) feedback;
static FIBONACCI(GetResult_Response) result;

static rcl_ret_t on_goal(rclc_action_goal_handle_t * goal, void * context)
{
  (void)goal;
  (void)context;
  return RCL_RET_ACTION_GOAL_ACCEPTED;
}

static bool on_cancel(rclc_action_goal_handle_t * goal, void * context)
{
  (void)goal;
  (void)context;
  return true;
}

static void on_answer(rclc_action_goal_handle_t * goal, bool accepted, void * context)
{
  (void)goal;
  (void)accepted;
  (void)context;
}

static void on_data(rclc_action_goal_handle_t * goal, void * data, void * context)
{
  (void)goal;
  (void)data;
  (void)context;
}

static void open_both(const rosidl_action_type_support_t * type)
{
  TELL(rclc_action_server_init_default(NULL, &node, &support, type, "walk"));
  TELL(rclc_action_server_init_default(&server, NULL, &support, type, "walk"));
  TELL(rclc_action_server_init_default(&server, &node, NULL, type, "walk"));
  TELL(rclc_action_server_init_default(&server, &node, &support, NULL, "walk"));
  TELL(rclc_action_server_init_default(&server, &node, &support, type, NULL));
  TELL(rclc_action_server_init_default(&server, &node, &support, type, ""));
  TELL(rclc_action_server_init_default(&server, &node, &support, type, "a b"));
  TELL(rclc_action_server_init_default(&server, &node, &support, type, "walk"));
  TELL(rcl_action_server_is_valid(&server.rcl_handle));
  TELL(rclc_action_client_init_default(NULL, &node, type, "run"));
  TELL(rclc_action_client_init_default(&client, NULL, type, "run"));
  TELL(rclc_action_client_init_default(&client, &node, NULL, "run"));
  TELL(rclc_action_client_init_default(&client, &node, type, NULL));
  TELL(rclc_action_client_init_default(&client, &node, type, ""));
  TELL(rclc_action_client_init_default(&client, &node, type, "a b"));
  TELL(rclc_action_client_init_default(&client, &node, type, "run"));
  TELL(rcl_action_client_is_valid(&client.rcl_handle));
}

static void add_server(void)
{
  TELL(rclc_executor_add_action_server(
    NULL, &server, GOALS, requests, sizeof(requests[0]), on_goal, on_cancel, NULL));
  TELL(rclc_executor_add_action_server(
    &executor, NULL, GOALS, requests, sizeof(requests[0]), on_goal, on_cancel, NULL));
  TELL(rclc_executor_add_action_server(
    &executor, &server, GOALS, NULL, sizeof(requests[0]), on_goal, on_cancel, NULL));
  TELL(rclc_executor_add_action_server(&executor, &server, GOALS, requests, 0, on_goal, on_cancel, NULL));
  TELL(rclc_executor_add_action_server(
    &executor, &server, GOALS, requests, sizeof(requests[0]), NULL, on_cancel, NULL));
  TELL(rclc_executor_add_action_server(
    &executor, &server, GOALS, requests, sizeof(requests[0]), on_goal, NULL, NULL));
  TELL(rclc_executor_add_action_server(
    &executor, &server, GOALS, requests, sizeof(requests[0]), on_goal, on_cancel, NULL));
}

static void add_client(void)
{
  TELL(rclc_executor_add_action_client(
    NULL, &client, GOALS, &result, &feedback, on_answer, on_data, on_data, on_answer, NULL));
  TELL(rclc_executor_add_action_client(
    &executor, NULL, GOALS, &result, &feedback, on_answer, on_data, on_data, on_answer, NULL));
  TELL(rclc_executor_add_action_client(
    &executor, &client, GOALS, NULL, &feedback, on_answer, on_data, on_data, on_answer, NULL));
  TELL(rclc_executor_add_action_client(
    &executor, &client, GOALS, &result, NULL, on_answer, on_data, on_data, on_answer, NULL));
  TELL(rclc_executor_add_action_client(
    &executor, &client, GOALS, &result, &feedback, NULL, on_data, on_data, on_answer, NULL));
  TELL(rclc_executor_add_action_client(
    &executor, &client, GOALS, &result, &feedback, on_answer, on_data, NULL, on_answer, NULL));
  TELL(rclc_executor_add_action_client(
    &executor, &client, GOALS, &result, NULL, on_answer, NULL, on_data, NULL, NULL));
}

/* Goals of the server and the client: what an application can do without the other side. */
static void goals(void)
{
  rclc_action_goal_handle_t * goal = NULL;
  rclc_action_goal_handle_t other;

  memset(&other, 0, sizeof(other));
  other.action_server = &server;
  TELL(rclc_action_publish_feedback(NULL, &feedback));
  TELL(rclc_action_publish_feedback(&other, NULL));
  TELL(rclc_action_publish_feedback(&other, &feedback)); /* no goal of the server */
  TELL(rclc_action_send_result(NULL, GOAL_STATE_SUCCEEDED, &result));
  TELL(rclc_action_send_result(&other, GOAL_STATE_SUCCEEDED, NULL));
  TELL(rclc_action_send_result(&other, GOAL_STATE_SUCCEEDED, &result));
  TELL(rclc_action_send_cancel_request(NULL));
  TELL(rclc_action_send_goal_request(NULL, &request, &goal));
  TELL(rclc_action_send_goal_request(&client, NULL, &goal));
  TELL(rclc_action_send_goal_request(&client, &request, &goal));
  TELL(goal != NULL);
  TELL(rclc_action_send_goal_request(&client, &request, NULL));
  TELL(rclc_action_send_goal_request(&client, &request, &goal)); /* both places are in use */
}

static void finish(void)
{
  TELL(rclc_action_server_fini(NULL, &node));
  TELL(rclc_action_server_fini(&server, NULL));
  TELL(rclc_action_client_fini(NULL, &node));
  TELL(rclc_action_client_fini(&client, NULL));
  TELL(rclc_executor_fini(&executor));
  TELL(rclc_action_server_fini(&server, &node));
  TELL(rclc_action_client_fini(&client, &node));
  TELL(rcl_action_server_is_valid(&server.rcl_handle));
  TELL(rcl_action_client_is_valid(&client.rcl_handle));
}

int main(void)
{
  const rosidl_action_type_support_t * type = FIBONACCI_TYPE;

  allocator = heap;
  TELL(rclc_support_init(&support, 0, NULL, &allocator));
  TELL(rclc_node_init_default(&node, "n", "", &support));
  for (int round = 0; round < 2; ++round) {
    open_both(type);
    executor = rclc_executor_get_zero_initialized_executor();
    TELL(rclc_action_send_goal_request(&client, &request, NULL)); /* it is not in an executor yet */
    TELL(rclc_executor_init(&executor, &support.context, 2, &allocator));
    add_server();
    add_client();
    goals();
    TELL(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(1)));
    finish();
  }
  TELL(rcl_node_fini(&node));
  TELL(rclc_support_fini(&support));
  return 0;
}
