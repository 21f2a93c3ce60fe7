/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An action server on a board. A goal of order N gives N - 1 times feedback, and its result has N numbers; one of
 * order 0 goes on until it is canceled. `actions_report` has what was accepted, ended and canceled.
 */
#ifdef LATE_CLOCK
#include "late_clock.h"
#endif

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <test_msgs/action/fibonacci.h>

enum { GOALS = 2, NUMBERS = 16 };

typedef struct walk_t {
  rclc_action_goal_handle_t * goal; /* NULL: free */
  int32_t numbers[NUMBERS];
  size_t count;
} walk_t;

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_action_server_t server;
static test_msgs__action__Fibonacci_SendGoal_Request requests[GOALS];
static walk_t walks[GOALS];

volatile uint32_t actions_report[3];

static rcl_ret_t on_goal(rclc_action_goal_handle_t * goal, void * context)
{
  (void)context;
  for (size_t i = 0; i < GOALS; ++i) {
    if (walks[i].goal == NULL) {
      walks[i].goal = goal;
      walks[i].count = 0;
      actions_report[0] = actions_report[0] + 1u;
      return RCL_RET_ACTION_GOAL_ACCEPTED;
    }
  }
  return RCL_RET_ACTION_GOAL_REJECTED;
}

static bool on_cancel(rclc_action_goal_handle_t * goal, void * context)
{
  (void)goal;
  (void)context;
  actions_report[2] = actions_report[2] + 1u;
  return true;
}

static void end(walk_t * walk, rcl_action_goal_state_t status)
{
  test_msgs__action__Fibonacci_GetResult_Response response;

  response.result.sequence.data = walk->numbers;
  response.result.sequence.size = walk->count;
  response.result.sequence.capacity = NUMBERS;
  if (rclc_action_send_result(walk->goal, status, &response) == RCL_RET_OK) {
    walk->goal = NULL;
    actions_report[1] = actions_report[1] + 1u;
  }
}

static void step(walk_t * walk)
{
  const test_msgs__action__Fibonacci_SendGoal_Request * request =
    (const test_msgs__action__Fibonacci_SendGoal_Request *)walk->goal->ros_goal_request;
  const size_t order = (size_t)request->goal.order;
  test_msgs__action__Fibonacci_FeedbackMessage message;

  if (walk->goal->goal_cancelled) {
    end(walk, GOAL_STATE_CANCELED);
  } else if (order != 0u && walk->count == order) {
    end(walk, GOAL_STATE_SUCCEEDED);
  } else if (walk->count < order) {
    walk->numbers[walk->count] = walk->count < 2u
                                   ? (int32_t)walk->count
                                   : walk->numbers[walk->count - 1u] + walk->numbers[walk->count - 2u];
    ++walk->count;
    message.feedback.sequence.data = walk->numbers;
    message.feedback.sequence.size = walk->count;
    message.feedback.sequence.capacity = NUMBERS;
    if (rclc_action_publish_feedback(walk->goal, &message) != RCL_RET_OK) {
      --walk->count; /* the stream is full: again in the next round */
    }
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK ||
    rclc_action_server_init_default(
      &server, &node, &support, ROSIDL_GET_ACTION_TYPE_SUPPORT(test_msgs, Fibonacci), "fibonacci") !=
      RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 1, &allocator) != RCL_RET_OK ||
    rclc_executor_add_action_server(
      &executor, &server, GOALS, requests, sizeof(requests[0]), on_goal, on_cancel, NULL) != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(50));
    for (size_t i = 0; i < GOALS; ++i) {
      if (walks[i].goal != NULL) {
        step(&walks[i]);
      }
    }
  }
}
