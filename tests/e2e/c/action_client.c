/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An action client in the hands of a test: one call for each line of standard input, answered with lines and
 * "ret CODE TEXT". Meanwhile the executor spins. Goals are numbered in the order in which they were sent; what their
 * callbacks got is kept as lines.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/action_client.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <test_msgs/action/fibonacci.h>

#include "commanded.h"

enum { GOALS = 2, KEPT = 64, EVENT_SIZE = 200 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rclc_action_client_t client;
static test_msgs__action__Fibonacci_SendGoal_Request requests[KEPT];
static test_msgs__action__Fibonacci_FeedbackMessage feedback_message;
static test_msgs__action__Fibonacci_GetResult_Response result_message;
static rclc_action_goal_handle_t * handles[KEPT];
static int count;
static char events[KEPT][EVENT_SIZE];
static int event_count;

/* Goals are known by the address of their requests, as rclc's examples do it. */
static int number_of(const rclc_action_goal_handle_t * goal, const void * context)
{
  const void * request = goal->ros_goal_request;

  if (context != &client || event_count == KEPT) {
    exit(1);
  }
  for (int i = 0; i < count; ++i) {
    if (request == &requests[i]) {
      return i;
    }
  }
  return -1;
}

static void keep_numbers(const char * what, int goal, int status, const int32_t * data, size_t size)
{
  char * line = events[event_count++];
  int used = snprintf(line, EVENT_SIZE, "%s %d %d", what, goal, status);

  for (size_t i = 0; i < size; ++i) {
    used += snprintf(&line[used], (size_t)(EVENT_SIZE - used), " %d", (int)data[i]);
  }
}

static void on_goal(rclc_action_goal_handle_t * goal, bool accepted, void * context)
{
  keep_numbers("goal", number_of(goal, context), accepted ? 1 : 0, NULL, 0);
}

static void on_feedback(rclc_action_goal_handle_t * goal, void * ros_feedback, void * context)
{
  const test_msgs__action__Fibonacci_FeedbackMessage * message = ros_feedback;

  keep_numbers(
    "feedback", number_of(goal, context), goal->status, message->feedback.sequence.data,
    message->feedback.sequence.size);
}

static void on_result(rclc_action_goal_handle_t * goal, void * ros_result_response, void * context)
{
  const test_msgs__action__Fibonacci_GetResult_Response * message = ros_result_response;

  keep_numbers(
    "result", number_of(goal, context), message->status, message->result.sequence.data,
    message->result.sequence.size);
}

static void on_cancel(rclc_action_goal_handle_t * goal, bool canceled, void * context)
{
  keep_numbers("cancel", number_of(goal, context), canceled ? 1 : 0, NULL, 0);
}

static void begin(void)
{
  check(
    rclc_action_client_init_default(
      &client, &node, ROSIDL_GET_ACTION_TYPE_SUPPORT(test_msgs, Fibonacci), "fibonacci"),
    "action client");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  check(
    rclc_executor_add_action_client(
      &executor, &client, GOALS, &result_message, &feedback_message, on_goal, on_feedback, on_result,
      on_cancel, &client),
    "add");
}

/* send ORDER | cancel I | id I | events | faults | available */
static rcl_ret_t run(char ** word)
{
  const char * what = word[0];

  if (strcmp(what, "send") == 0) {
    requests[count].goal.order = atoi(word[1]);
    const rcl_ret_t result = rclc_action_send_goal_request(&client, &requests[count], &handles[count]);

    count += result == RCL_RET_OK ? 1 : 0;
    return result;
  }
  if (strcmp(what, "cancel") == 0) {
    return rclc_action_send_cancel_request(handles[atoi(word[1])]);
  }
  if (strcmp(what, "id") == 0) {
    for (size_t i = 0; i < UUID_SIZE; ++i) {
      (void)printf("%02x", requests[atoi(word[1])].goal_id.uuid[i]);
    }
    (void)printf("\n");
  } else if (strcmp(what, "events") == 0) {
    for (int i = 0; i < event_count; ++i) {
      (void)printf("%s\n", events[i]);
    }
  } else if (strcmp(what, "faults") == 0) {
    (void)printf("%u %s\n", faults, last_error);
  } else if (strcmp(what, "available") == 0) {
    bool available = false;
    const rcl_ret_t result = rcl_action_server_is_available(&node, &client.rcl_handle, &available);

    (void)printf("%d\n", available ? 1 : 0);
    return result;
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
  check(rclc_action_client_fini(&client, &node), "action client fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
