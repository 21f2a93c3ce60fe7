/* SPDX-License-Identifier: Apache-2.0 */
/* A node with a life cycle in the hands of the test: one call for each line of standard input. */
#include "fake_no_wait.h"
#include "fake_program.h"
#include "retained_file.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_lifecycle/rclc_lifecycle.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};
static rcl_publisher_t managed;
static rcl_publisher_t free_one;
static rcl_timer_t managed_timer;
static rcl_timer_t free_timer;
static int managed_calls;
static int free_calls;

static void on_managed(rcl_timer_t * timer, int64_t since_last_call)
{
  (void)timer;
  (void)since_last_call;
  ++managed_calls;
}

static void on_free(rcl_timer_t * timer, int64_t since_last_call)
{
  (void)timer;
  (void)since_last_call;
  ++free_calls;
}

static rcl_ret_t init(void)
{
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &managed, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &free_one, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "status");
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 5, &allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_timer_init_default2(&managed_timer, &support, RCL_MS_TO_NS(20), on_managed, true);
  }
  if (result == RCL_RET_OK) {
    result = rclc_timer_init_default2(&free_timer, &support, RCL_MS_TO_NS(30), on_free, true);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_timer(&executor, &managed_timer);
  }
  return result == RCL_RET_OK ? rclc_executor_add_timer(&executor, &free_timer) : result;
}

static rcl_ret_t make(void)
{
  rcl_ret_t result = rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true);

  if (result == RCL_RET_OK) {
    result = rclc_lifecycle_init_change_state_server(&context, &executor);
  }
  if (result == RCL_RET_OK) {
    result = rclc_lifecycle_init_get_state_server(&context, &executor);
  }
  return result == RCL_RET_OK ? rclc_lifecycle_init_get_available_states_server(&context, &executor) : result;
}

static rcl_ret_t publish(const rcl_publisher_t * publisher, const char * value)
{
  const std_msgs__msg__Int32 message = {atoi(value)};

  return rcl_publish(publisher, &message, NULL);
}

static rcl_ret_t statistics(void)
{
  rmw_uros_statistics_t found;
  const rmw_ret_t result = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &found);

  printf("dropped %" PRIu32 "\n", found.dropped);
  return result;
}

static rcl_ret_t end(void)
{
  rcl_ret_t result = rclc_lifecycle_node_fini(&lifecycle, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_executor_fini(&executor);
  }
  if (result == RCL_RET_OK) {
    result = rcl_node_fini(&node);
  }
  return result == RCL_RET_OK ? rclc_support_fini(&support) : result;
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
  if (strcmp(word, "change") == 0) {
    return rclc_lifecycle_change_state(&lifecycle, (unsigned int)atoi(argument), true);
  }
  if (strcmp(word, "state") == 0) {
    printf("state %s\n", machine.current_state->label);
    return RCL_RET_OK;
  }
  if (strcmp(word, "managed") == 0) {
    return publish(&managed, argument);
  }
  if (strcmp(word, "free") == 0) {
    return publish(&free_one, argument);
  }
  if (strcmp(word, "period") == 0) {
    int64_t before;

    return rcl_timer_exchange_period(&managed_timer, RCL_MS_TO_NS(atoi(argument)), &before);
  }
  if (strcmp(word, "calls") == 0) {
    printf("calls %d %d\n", managed_calls, free_calls);
    managed_calls = 0;
    free_calls = 0;
    return RCL_RET_OK;
  }
  if (strcmp(word, "statistics") == 0) {
    return statistics();
  }
  if (strcmp(word, "close") == 0) {
    return rcl_service_fini(&machine.com_interface.srv_get_transition_graph, &node);
  }
  if (strcmp(word, "sleep") == 0) {
    return go_to_sleep(&support, argument);
  }
  if (strcmp(word, "wake") == 0) {
    return wake_up(argument);
  }
  if (strcmp(word, "end") == 0) {
    return end();
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
