/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with a life cycle whose publisher `position` and whose timer are managed; `battery` is not. Each line of
 * standard input is one call, answered with lines and "ret CODE TEXT". Meanwhile the executor spins.
 */
#define _POSIX_C_SOURCE 200809L
#include <poll.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rcl_lifecycle/managed_timers.h>
#include <rclc_lifecycle/rclc_lifecycle.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t position;
static rcl_publisher_t battery;
static rcl_timer_t timer;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static rcl_lifecycle_state_machine_t machine;
static rclc_lifecycle_node_t lifecycle;
static rclc_lifecycle_service_context_t context = {&lifecycle};
static unsigned int ticks;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void on_timer(rcl_timer_t * called, int64_t since_last_call)
{
  (void)called;
  (void)since_last_call;
  ++ticks;
}

/* publish VALUE: with both publishers | dropped | ticks | skipped */
static rcl_ret_t run(const char * what, const char * value)
{
  std_msgs__msg__Int32 number = {0};
  rmw_uros_statistics_t statistics;
  rcl_lifecycle_timer_statistics_t skips = {0};
  rcl_ret_t result = RCL_RET_OK;

  if (strcmp(what, "publish") == 0) {
    number.data = (int32_t)atoi(value);
    result = rcl_publish(&position, &number, NULL);
    return result == RCL_RET_OK ? rcl_publish(&battery, &number, NULL) : result;
  }
  if (strcmp(what, "dropped") == 0) {
    result = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics);
    (void)printf("%u\n", (unsigned int)statistics.dropped);
  } else if (strcmp(what, "ticks") == 0) {
    (void)printf("%u\n", ticks);
  } else if (strcmp(what, "skipped") == 0) {
    result = rcl_lifecycle_get_timer_statistics(&timer, strcmp(value, "nowhere") == 0 ? NULL : &skips);
    (void)printf("%u\n", (unsigned int)skips.skipped);
  } else {
    return RCL_RET_INVALID_ARGUMENT;
  }
  return result;
}

static bool answer(void)
{
  static char line[256];
  char what[32] = "";
  char value[32] = "";
  rcl_ret_t result;

  if (fgets(line, sizeof(line), stdin) == NULL || strcmp(line, "end\n") == 0) {
    return false;
  }
  (void)sscanf(line, "%31s %31s", what, value);
  result = run(what, value);
  (void)printf("ret %d %s\n", (int)result, result == RCL_RET_OK ? "" : rcl_get_error_string().str);
  (void)fflush(stdout);
  rcl_reset_error();
  return true;
}

static void begin(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  allocator = rcl_get_default_allocator();
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "gates", &support), "node");
  check(rclc_publisher_init_default(&position, &node, type, "position"), "position");
  check(rclc_publisher_init_default(&battery, &node, type, "battery"), "battery");
  check(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(10), on_timer, true), "timer");
  check(rclc_make_node_a_lifecycle_node(&lifecycle, &node, &machine, &allocator, true), "life cycle");
  check(rclc_executor_init(&executor, &support.context, 4, &allocator), "executor");
  check(rclc_lifecycle_init_get_state_server(&context, &executor), "get_state");
  check(rclc_lifecycle_init_get_available_states_server(&context, &executor), "get_available_states");
  check(rclc_lifecycle_init_change_state_server(&context, &executor), "change_state");
  check(rclc_executor_add_timer(&executor, &timer), "add timer");
}

int main(void)
{
  struct pollfd input = {0, POLLIN, 0};
  bool goes_on = true;

  (void)setvbuf(stdin, NULL, _IONBF, 0);
  begin();
  while (goes_on) {
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(2)), "spin");
    if (poll(&input, 1, 0) > 0) {
      goes_on = answer();
    }
  }
  check(rclc_executor_fini(&executor), "executor fini");
  check(rclc_lifecycle_node_fini(&lifecycle, &allocator), "life cycle fini");
  check(rcl_timer_fini(&timer), "timer fini");
  check(rcl_publisher_fini(&battery, &node), "battery fini");
  check(rcl_publisher_fini(&position, &node), "position fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
