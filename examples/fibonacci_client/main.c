/* SPDX-License-Identifier: Apache-2.0 */
/* Has Fibonacci numbers counted by an action, prints its feedback, and ends with the result. */
#include "../example.h"

#include <example_interfaces/action/fibonacci.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

enum { ORDER = 7 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_action_client_t client;
static rclc_executor_t executor;
static example_interfaces__action__Fibonacci_SendGoal_Request request;
static example_interfaces__action__Fibonacci_FeedbackMessage feedback;
static example_interfaces__action__Fibonacci_GetResult_Response result;
static bool is_sent;
static bool has_ended;

static void print_numbers(const char * what, const rosidl_runtime_c__int32__Sequence * numbers)
{
  (void)printf("%s:", what);
  for (size_t i = 0; i < numbers->size; ++i) {
    (void)printf(" %d", (int)numbers->data[i]);
  }
  (void)printf("\n");
}

/* The server may not be there yet: then the goal is sent once more. */
static void note_response(rclc_action_goal_handle_t * goal, bool accepted, void * context)
{
  (void)goal;
  (void)context;
  (void)printf("%s\n", accepted ? "accepted" : "not accepted");
  is_sent = accepted;
}

static void print_feedback(rclc_action_goal_handle_t * goal, void * message, void * context)
{
  const example_interfaces__action__Fibonacci_FeedbackMessage * received = message;

  (void)goal;
  (void)context;
  print_numbers("feedback", &received->feedback.sequence);
}

static void print_result(rclc_action_goal_handle_t * goal, void * response, void * context)
{
  const example_interfaces__action__Fibonacci_GetResult_Response * received = response;

  (void)goal;
  (void)context;
  print_numbers(received->status == GOAL_STATE_SUCCEEDED ? "succeeded" : "ended", &received->result.sequence);
  has_ended = true;
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "counting", "", &support), "node");
  example_check(
    rclc_action_client_init_default(
      &client, &node, ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci), "fibonacci"),
    "action client");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  example_check(
    rclc_executor_add_action_client(
      &executor, &client, 1, &result, &feedback, note_response, print_feedback, print_result, NULL, NULL),
    "add action client");
  request.goal.order = ORDER;
  while (example_runs() && !has_ended) {
    if (!is_sent) {
      is_sent = example_tell(rclc_action_send_goal_request(&client, &request, NULL), "goal");
    }
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rclc_action_client_fini(&client, &node), "end of the action client");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
