/* SPDX-License-Identifier: Apache-2.0 */
/* Two action clients in the hands of the test: one call for each line of standard input; callbacks print lines. */
#include "fake_no_wait.h"
#include "fake_program.h"

#include <example_interfaces/action/fibonacci.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/executor_nodes.h>
#include <rclc/rclc.h>
#include <tf2_msgs/action/lookup_transform.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GOALS = 2, KEPT = 32 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rclc_action_client_t walk;
static rclc_action_client_t find;
static example_interfaces__action__Fibonacci_SendGoal_Request walks[KEPT];
static example_interfaces__action__Fibonacci_FeedbackMessage feedback_message;
static example_interfaces__action__Fibonacci_GetResult_Response result_message;
static tf2_msgs__action__LookupTransform_GetResult_Response found_message;
static rclc_action_goal_handle_t * goals[KEPT];
static int count;
static char closes_in[16];

/* Prints what a callback got, and closes the client in the callback that the test chose. */
static void report(
  const char * what, const rclc_action_goal_handle_t * goal, int value, const int32_t * data, size_t size)
{
  const void * request = goal->ros_goal_request;
  int number = -1;

  for (int i = 0; i < count; ++i) {
    number = request == &walks[i] ? i : number;
  }
  printf("%s %d %d", what, number, value);
  for (size_t i = 0; i < size; ++i) {
    printf(" %d", (int)data[i]);
  }
  printf("\n");
  if (strcmp(what, closes_in) == 0) {
    (void)rclc_action_client_fini(&walk, &node);
  }
}

static void on_goal(rclc_action_goal_handle_t * goal, bool accepted, void * context)
{
  (void)context;
  report("goal", goal, accepted ? 1 : 0, NULL, 0);
}

static void on_feedback(rclc_action_goal_handle_t * goal, void * ros_feedback, void * context)
{
  const example_interfaces__action__Fibonacci_FeedbackMessage * message = ros_feedback;

  (void)context;
  report("feedback", goal, (int)message->feedback.sequence.size, NULL, 0);
}

static void on_result(rclc_action_goal_handle_t * goal, void * ros_result_response, void * context)
{
  const example_interfaces__action__Fibonacci_GetResult_Response * message = ros_result_response;

  (void)context;
  report("result", goal, message->status, message->result.sequence.data, message->result.sequence.size);
}

static void on_cancel(rclc_action_goal_handle_t * goal, bool canceled, void * context)
{
  (void)context;
  report("cancel", goal, canceled ? 1 : 0, NULL, 0);
}

static rcl_ret_t init(void)
{
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 2, &allocator);
  }
  return result;
}

static rcl_ret_t add(size_t handles)
{
  return rclc_executor_add_action_client(
    &executor, &walk, handles, &result_message, &feedback_message, on_goal, on_feedback, on_result, on_cancel,
    NULL);
}

static rcl_ret_t make(void)
{
  rcl_ret_t result = rclc_action_client_init_default(
    &walk, &node, ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci), "walk");

  if (result == RCL_RET_OK) {
    result = rclc_action_client_init_default(
      &find, &node, ROSIDL_GET_ACTION_TYPE_SUPPORT(tf2_msgs, LookupTransform), "/find");
  }
  if (result == RCL_RET_OK) {
    result = add(GOALS);
  }
  return result == RCL_RET_OK
           ? rclc_executor_add_action_client(
               &executor, &find, 1, &found_message, NULL, on_goal, NULL, on_result, NULL, NULL)
           : result;
}

static rcl_ret_t send_goal(int order)
{
  rcl_ret_t result;

  walks[count].goal.order = order;
  result = rclc_action_send_goal_request(&walk, &walks[count], &goals[count]);
  count += result == RCL_RET_OK ? 1 : 0;
  return result;
}

/* Asks for the transform of a frame with this name. */
static rcl_ret_t look(char * frame)
{
  static tf2_msgs__action__LookupTransform_SendGoal_Request request;

  request.goal.target_frame.data = frame;
  request.goal.target_frame.size = strlen(frame);
  request.goal.target_frame.capacity = request.goal.target_frame.size + 1u;
  return rclc_action_send_goal_request(&find, &request, NULL);
}

static rcl_ret_t refuse(const char * what)
{
  static rclc_action_client_t other;
  const rosidl_action_type_support_t * type = ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci);

  if (strcmp(what, "name") == 0) {
    return rclc_action_client_init_default(&other, &node, type, "run");
  }
  if (strcmp(what, "type") == 0) {
    return rclc_action_client_init_default(&other, &node, type, "find");
  }
  if (strcmp(what, "twice") == 0) {
    return rclc_action_client_init_default(&other, &node, type, "walk");
  }
  if (strcmp(what, "goals") == 0) {
    return add(GOALS + 1);
  }
  if (strcmp(what, "closed") == 0) {
    return rclc_action_send_goal_request(&other, &walks[0], NULL);
  }
  if (strcmp(what, "no_feedback") == 0) {
    return rclc_executor_add_action_client(
      &executor, &find, 1, &found_message, NULL, on_goal, on_feedback, on_result, NULL, NULL);
  }
  return RCL_RET_OK;
}

static rcl_ret_t call(char * line)
{
  const char * word = strtok(line, " ");
  char * argument = strtok(NULL, " ");

  if (strcmp(word, "init") == 0) {
    return init();
  }
  if (strcmp(word, "names") == 0) {
    const char * const name = rcl_action_client_get_action_name(&find.rcl_handle);

    printf(
      "names %s %s %d\n", rcl_action_client_get_action_name(&walk.rcl_handle), name,
      rcl_action_client_is_valid(&find.rcl_handle) ? 1 : 0);
    return RCL_RET_OK;
  }
  if (strcmp(word, "make") == 0) {
    return make();
  }
  if (strcmp(word, "refuse") == 0) {
    return refuse(argument);
  }
  if (strcmp(word, "send") == 0) {
    return send_goal(atoi(argument));
  }
  if (strcmp(word, "look") == 0) {
    return look(argument);
  }
  if (strcmp(word, "cancel") == 0) {
    return rclc_action_send_cancel_request(goals[atoi(argument)]);
  }
  if (strcmp(word, "ask") == 0) {
    return rclc_action_send_result_request(goals[atoi(argument)]);
  }
  if (strcmp(word, "close_in") == 0) {
    (void)snprintf(closes_in, sizeof(closes_in), "%s", argument);
    return RCL_RET_OK;
  }
  if (strcmp(word, "remove") == 0) {
    return rclc_executor_remove_action_client(&executor, &walk);
  }
  if (strcmp(word, "add") == 0) {
    return add(argument != NULL ? (size_t)atoi(argument) : GOALS);
  }
  if (strcmp(word, "leave") == 0) {
    return rclc_executor_remove_node(&executor, &node);
  }
  if (strcmp(word, "return") == 0) {
    return rclc_executor_add_node(&executor, &node);
  }
  if (strcmp(word, "query") == 0) {
    rclc_executor_node_info_t info = {0, 0};
    const rcl_ret_t result = rclc_executor_query_node(&executor, &node, &info);

    printf("nodes %u %u\n", (unsigned int)info.running, (unsigned int)info.removed);
    return result;
  }
  if (strcmp(word, "let") == 0) {
    return rclc_executor_set_semantics(&executor, RCLC_SEMANTICS_LOGICAL_EXECUTION_TIME);
  }
  return rclc_executor_spin_some(&executor, 0);
}

static void work(char * line)
{
  report_result(call(line));
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  return run_calls(work);
}
