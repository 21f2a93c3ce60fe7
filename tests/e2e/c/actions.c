/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An action server in the hands of a test: one call for each line of standard input, answered with lines and
 * "ret CODE TEXT". Meanwhile the executor spins. Goals are kept in the order in which they were accepted.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <test_msgs/action/fibonacci.h>

#include "commanded.h"

enum { GOALS = 2, KEPT = 64, NUMBERS = 24 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rclc_action_server_t server;
static test_msgs__action__Fibonacci_SendGoal_Request requests[GOALS];
static rclc_action_goal_handle_t * goals[KEPT];
static int count;
static int rejects;
static int keeps_going;
static int ends_at_cancel;
static int cancels;

static rcl_ret_t end_goal(rclc_action_goal_handle_t * goal, int status, int numbers)
{
  static int32_t data[NUMBERS];
  test_msgs__action__Fibonacci_GetResult_Response response;

  for (int i = 0; i < numbers; ++i) {
    data[i] = i < 2 ? i : data[i - 1] + data[i - 2];
  }
  response.result.sequence.data = data;
  response.result.sequence.size = (size_t)numbers;
  response.result.sequence.capacity = NUMBERS;
  return rclc_action_send_result(goal, (rcl_action_goal_state_t)status, &response);
}

static rcl_ret_t on_goal(rclc_action_goal_handle_t * goal, void * context)
{
  if (context != &server) {
    exit(1);
  }
  if (rejects != 0 || count == KEPT) {
    return RCL_RET_ACTION_GOAL_REJECTED;
  }
  if (end_goal(goal, GOAL_STATE_SUCCEEDED, 0) != RCLC_RET_ACTION_WAIT_RESULT_REQUEST) {
    exit(1);
  }
  goals[count++] = goal;
  return RCL_RET_ACTION_GOAL_ACCEPTED;
}

static bool on_cancel(rclc_action_goal_handle_t * goal, void * context)
{
  if (context != &server || goal->status != GOAL_STATE_CANCELING) {
    exit(1);
  }
  ++cancels;
  if (ends_at_cancel != 0) {
    check(end_goal(goal, GOAL_STATE_CANCELED, 1), "result in the callback");
  }
  return keeps_going == 0;
}

static rcl_ret_t feedback(rclc_action_goal_handle_t * goal, int numbers)
{
  static int32_t data[NUMBERS];
  test_msgs__action__Fibonacci_FeedbackMessage message;

  for (int i = 0; i < numbers; ++i) {
    data[i] = i;
  }
  message.feedback.sequence.data = data;
  message.feedback.sequence.size = (size_t)numbers;
  message.feedback.sequence.capacity = NUMBERS;
  return rclc_action_publish_feedback(goal, &message);
}

static void begin(void)
{
  check(
    rclc_action_server_init_default(
      &server, &node, &support, ROSIDL_GET_ACTION_TYPE_SUPPORT(test_msgs, Fibonacci), "fibonacci"),
    "action server");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  check(
    rclc_executor_add_action_server(
      &executor, &server, GOALS, requests, sizeof(requests[0]), on_goal, on_cancel, &server),
    "add");
}

static void print_goal(int index)
{
  const rclc_action_goal_handle_t * goal = goals[index];
  const test_msgs__action__Fibonacci_SendGoal_Request * request =
    (const test_msgs__action__Fibonacci_SendGoal_Request *)goal->ros_goal_request;

  (void)printf("%d %d %d\n", (int)request->goal.order, (int)goal->status, goal->goal_cancelled ? 1 : 0);
}

/* reject 0|1 | keep 0|1 | end_at_cancel 0|1 | goal I | count | cancels | feedback I N | end I STATUS N | refused | reset */
static rcl_ret_t run(char ** word)
{
  const char * what = word[0];

  if (strcmp(what, "reject") == 0) {
    rejects = atoi(word[1]);
  } else if (strcmp(what, "keep") == 0) {
    keeps_going = atoi(word[1]);
  } else if (strcmp(what, "end_at_cancel") == 0) {
    ends_at_cancel = atoi(word[1]);
  } else if (strcmp(what, "goal") == 0) {
    print_goal(atoi(word[1]));
  } else if (strcmp(what, "count") == 0) {
    (void)printf("%d\n", count);
  } else if (strcmp(what, "cancels") == 0) {
    (void)printf("%d\n", cancels);
  } else if (strcmp(what, "feedback") == 0) {
    return feedback(goals[atoi(word[1])], atoi(word[2]));
  } else if (strcmp(what, "end") == 0) {
    return end_goal(goals[atoi(word[1])], atoi(word[2]), atoi(word[3]));
  } else if (strcmp(what, "refused") == 0) {
    (void)printf("%u %s\n", (unsigned int)server.refused_goals, last_error);
  } else if (strcmp(what, "reset") == 0) {
    check(rclc_executor_fini(&executor), "executor fini");
    check(rclc_action_server_fini(&server, &node), "action server fini");
    count = 0;
    cancels = 0;
    begin();
  } else {
    return RCL_RET_INVALID_ARGUMENT;
  }
  return RCL_RET_OK;
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "arm", &support), "node");
  begin();
  obey(&executor, 2, run);
  check(rclc_executor_fini(&executor), "executor fini");
  check(rclc_action_server_fini(&server, &node), "action server fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
