/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An action client on a board: one goal of order 6 after another until one has succeeded, then one of order 0, which is
 * canceled as soon as it is accepted. `client_report` has how many goals were accepted, how much feedback came, the last
 * number of the first result, and the status of the second.
 */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <test_msgs/action/fibonacci.h>

enum { GOALS = 2, ORDER = 6 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_action_client_t client;
static test_msgs__action__Fibonacci_SendGoal_Request requests[GOALS];
static test_msgs__action__Fibonacci_FeedbackMessage feedback;
static test_msgs__action__Fibonacci_GetResult_Response result;
static bool is_sent;

volatile uint32_t client_report[4];

static bool is_first(const rclc_action_goal_handle_t * goal)
{
  return (const void *)goal->ros_goal_request == (const void *)&requests[0];
}

static void on_goal(rclc_action_goal_handle_t * goal, bool accepted, void * context)
{
  (void)context;
  is_sent = accepted;
  if (accepted) {
    client_report[0] = client_report[0] + 1u;
    if (!is_first(goal)) {
      (void)rclc_action_send_cancel_request(goal);
    }
  }
}

static void on_feedback(rclc_action_goal_handle_t * goal, void * message, void * context)
{
  (void)goal;
  (void)message;
  (void)context;
  client_report[1] = client_report[1] + 1u;
}

static void on_result(rclc_action_goal_handle_t * goal, void * message, void * context)
{
  const test_msgs__action__Fibonacci_GetResult_Response * response = message;

  (void)context;
  is_sent = false;
  if (!is_first(goal)) {
    client_report[3] = (uint32_t)response->status;
  } else if (response->status == GOAL_STATE_SUCCEEDED && response->result.sequence.size == (size_t)ORDER) {
    client_report[2] = (uint32_t)response->result.sequence.data[ORDER - 1];
  }
}

static rcl_ret_t make(const rcl_allocator_t * allocator)
{
  rcl_ret_t made = rclc_action_client_init_default(
    &client, &node, ROSIDL_GET_ACTION_TYPE_SUPPORT(test_msgs, Fibonacci), "fibonacci");

  if (made == RCL_RET_OK) {
    made = rclc_executor_init(&executor, &support.context, 1, allocator);
  }
  return made == RCL_RET_OK
           ? rclc_executor_add_action_client(
               &executor, &client, GOALS, &result, &feedback, on_goal, on_feedback, on_result, NULL, NULL)
           : made;
}

/* Sends the goal that is to be sent next, if none is under way. */
static void step(void)
{
  const size_t which = client_report[2] == 0u ? 0u : 1u;

  if (!is_sent && client_report[3] == 0u) {
    requests[which].goal.order = which == 0u ? ORDER : 0;
    is_sent = rclc_action_send_goal_request(&client, &requests[which], NULL) == RCL_RET_OK;
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK ||
    make(&allocator) != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
    step();
  }
}
