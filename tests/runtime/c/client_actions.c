/* SPDX-License-Identifier: Apache-2.0 */
/* Two action servers in the hands of the test: one call for each line of standard input. */
#include "fake_no_wait.h"
#include "fake_program.h"

#include <example_interfaces/action/fibonacci.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
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
static rclc_action_server_t walk;
static rclc_action_server_t find;
static example_interfaces__action__Fibonacci_SendGoal_Request walks[GOALS];
static tf2_msgs__action__LookupTransform_SendGoal_Request finds[1];
static rclc_action_goal_handle_t * goals[KEPT];
static int count;
static bool closes;

static rcl_ret_t on_goal(rclc_action_goal_handle_t * goal, void * context)
{
  (void)context;
  if (closes) {
    (void)rclc_action_server_fini(&walk, &node);
    return RCL_RET_ACTION_GOAL_ACCEPTED;
  }
  goals[count++] = goal;
  return RCL_RET_ACTION_GOAL_ACCEPTED;
}

static bool on_cancel(rclc_action_goal_handle_t * goal, void * context)
{
  (void)goal;
  (void)context;
  return true;
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

static rcl_ret_t make(void)
{
  rcl_ret_t result = rclc_action_server_init_default(
    &walk, &node, &support, ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci), "walk");

  if (result == RCL_RET_OK) {
    result = rclc_action_server_init_default(
      &find, &node, &support, ROSIDL_GET_ACTION_TYPE_SUPPORT(tf2_msgs, LookupTransform), "/find");
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_action_server(
      &executor, &walk, GOALS, walks, sizeof(walks[0]), on_goal, on_cancel, NULL);
  }
  return result == RCL_RET_OK ? rclc_executor_add_action_server(
                                  &executor, &find, 1, finds, sizeof(finds[0]), on_goal, on_cancel, NULL)
                              : result;
}

static rcl_ret_t end_goal(const char * index, const char * status)
{
  example_interfaces__action__Fibonacci_GetResult_Response response;
  int32_t data[] = {5};

  response.result.sequence.data = data;
  response.result.sequence.size = 1;
  response.result.sequence.capacity = 1;
  return rclc_action_send_result(goals[atoi(index)], (rcl_action_goal_state_t)atoi(status), &response);
}

static rcl_ret_t refuse(const char * what)
{
  static rclc_action_server_t other;
  const rosidl_action_type_support_t * type = ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci);

  if (strcmp(what, "name") == 0) {
    return rclc_action_server_init_default(&other, &node, &support, type, "run");
  }
  if (strcmp(what, "type") == 0) {
    return rclc_action_server_init_default(&other, &node, &support, type, "find");
  }
  if (strcmp(what, "twice") == 0) {
    return rclc_action_server_init_default(&other, &node, &support, type, "walk");
  }
  if (strcmp(what, "goals") == 0) {
    return rclc_executor_add_action_server(
      &executor, &walk, GOALS + 1, walks, sizeof(walks[0]), on_goal, on_cancel, NULL);
  }
  return rclc_executor_add_action_server(
    &executor, &walk, GOALS, walks, sizeof(walks[0]) + 1u, on_goal, on_cancel, NULL);
}

/* The handles and the list of states, each goal as id, state, active, cancelable; they have to agree. */
static rcl_ret_t list_goals(const rcl_action_server_t * server)
{
  rcl_action_goal_status_array_t states = rcl_action_get_zero_initialized_goal_status_array();
  rcl_action_goal_handle_t ** handles = NULL;
  size_t number = 99;
  rcl_ret_t result = rcl_action_server_get_goal_handles(server, &handles, &number);

  if (result == RCL_RET_OK) {
    result = rcl_action_get_goal_status_array(server, &states);
  }
  if (result != RCL_RET_OK || states.msg.status_list.size != number) {
    printf("goals %u of %u\n", (unsigned int)number, (unsigned int)states.msg.status_list.size);
    return result != RCL_RET_OK ? result : RCL_RET_ERROR;
  }
  for (size_t i = 0; i < number; ++i) {
    const action_msgs__msg__GoalStatus * state = &states.msg.status_list.data[i];
    rcl_action_goal_info_t info;
    rcl_action_goal_state_t status = GOAL_STATE_UNKNOWN;

    if (
      rcl_action_goal_handle_get_info(handles[i], &info) != RCL_RET_OK ||
      rcl_action_goal_handle_get_status(handles[i], &status) != RCL_RET_OK || status != state->status ||
      !uuidcmp(info.goal_id.uuid, state->goal_info.goal_id.uuid) ||
      info.stamp.nanosec != state->goal_info.stamp.nanosec) {
      return RCL_RET_ERROR;
    }
    printf(
      "goal %d %d %d %d\n", info.goal_id.uuid[0], status,
      rcl_action_goal_handle_is_active(handles[i]) ? 1 : 0,
      rcl_action_goal_handle_is_cancelable(handles[i]) ? 1 : 0);
  }
  return rcl_action_goal_status_array_fini(&states);
}

static rcl_ret_t expire(size_t capacity)
{
  rcl_action_goal_info_t expired[GOALS];
  size_t number = 0;
  const rcl_ret_t result = capacity == 0u
                             ? rcl_action_expire_goals(&walk.rcl_handle, NULL, 0, NULL)
                             : rcl_action_expire_goals(&walk.rcl_handle, expired, capacity, &number);

  for (size_t i = 0; i < number; ++i) {
    printf("expired %d\n", expired[i].goal_id.uuid[0]);
  }
  return result;
}

/* Feedback and states that the program publishes itself, both of a goal with this id. */
static rcl_ret_t say(int goal)
{
  example_interfaces__action__Fibonacci_FeedbackMessage feedback;
  action_msgs__msg__GoalStatusArray states;
  action_msgs__msg__GoalStatus state;
  rcl_ret_t result;

  (void)memset(&feedback, 0, sizeof(feedback));
  (void)memset(&state, 0, sizeof(state));
  feedback.goal_id.uuid[0] = (uint8_t)goal;
  state.goal_info.goal_id.uuid[0] = (uint8_t)goal;
  state.status = GOAL_STATE_EXECUTING;
  states.status_list.data = &state;
  states.status_list.size = 1;
  states.status_list.capacity = 1;
  result = rcl_action_publish_feedback(&walk.rcl_handle, &feedback);
  return result == RCL_RET_OK ? rcl_action_publish_status(&walk.rcl_handle, &states) : result;
}

static rcl_ret_t call(char * line)
{
  const char * word = strtok(line, " ");
  const char * argument = strtok(NULL, " ");

  if (strcmp(word, "init") == 0) {
    return init();
  }
  if (strcmp(word, "make") == 0) {
    return make();
  }
  if (strcmp(word, "refuse") == 0) {
    return refuse(argument);
  }
  if (strcmp(word, "end") == 0) {
    return end_goal(argument, strtok(NULL, " "));
  }
  if (strcmp(word, "frame") == 0) {
    printf("frame %s\n", finds[0].goal.target_frame.data);
    return RCL_RET_OK;
  }
  if (strcmp(word, "refused") == 0) {
    printf("refused %u %u\n", (unsigned int)walk.refused_goals, (unsigned int)find.refused_goals);
    return RCL_RET_OK;
  }
  if (strcmp(word, "close") == 0) {
    closes = true;
    return RCL_RET_OK;
  }
  if (strcmp(word, "remove") == 0) {
    return rclc_executor_remove_action_server(&executor, &walk);
  }
  if (strcmp(word, "known") == 0) {
    rcl_action_goal_info_t info;

    (void)memset(&info, 0, sizeof(info));
    for (int i = 0; i < UUID_SIZE; ++i) {
      info.goal_id.uuid[i] = (uint8_t)(i == 0 ? atoi(argument) : i - 1);
    }
    printf(
      "known %d %d\n", rcl_action_server_goal_exists(&walk.rcl_handle, &info) ? 1 : 0,
      rcl_action_server_goal_exists(&find.rcl_handle, &info) ? 1 : 0);
    return RCL_RET_OK;
  }
  if (strcmp(word, "valid") == 0) {
    const rcl_action_server_t none = rcl_action_get_zero_initialized_server();

    printf(
      "valid %d %d %d %d\n", rcl_action_server_is_valid(&walk.rcl_handle) ? 1 : 0,
      rcl_action_server_is_valid(&none) ? 1 : 0, rcl_action_server_is_valid(NULL) ? 1 : 0,
      rcl_action_server_goal_exists(&walk.rcl_handle, NULL) ? 1 : 0);
    rcl_reset_error();
    return RCL_RET_OK;
  }
  if (strcmp(word, "goals") == 0) {
    return list_goals(strcmp(argument, "walk") == 0 ? &walk.rcl_handle : &find.rcl_handle);
  }
  if (strcmp(word, "expire") == 0) {
    return expire((size_t)atoi(argument));
  }
  if (strcmp(word, "say") == 0) {
    return say(atoi(argument));
  }
  if (strcmp(word, "name") == 0) {
    printf(
      "name %s %s\n", rcl_action_server_get_action_name(&walk.rcl_handle),
      rcl_action_server_get_action_name(&find.rcl_handle));
    return RCL_RET_OK;
  }
  if (strcmp(word, "add") == 0) {
    return rclc_executor_add_action_server(
      &executor, &walk, (size_t)atoi(argument), walks, sizeof(walks[0]), on_goal, on_cancel, NULL);
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
