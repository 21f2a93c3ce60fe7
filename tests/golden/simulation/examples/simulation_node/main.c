/*
 * An application for simulation_node, to start from: copy it out of this folder and change it.
 * It has an executor take std_msgs/msg/Int32 on heard, std_msgs/msg/String on said.
 */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/detail/string__storage.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>

#include <stdint.h>
#include <stdio.h>

/* Number of samples before the program ends: by default enough for years. */
#ifndef EXAMPLE_SAMPLES
#define EXAMPLE_SAMPLES UINT32_MAX
#endif

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription_1;
static std_msgs__msg__Int32 int32_received_1;
static rcl_subscription_t subscription_2;
static std_msgs__msg__String string_received_2;
static std_msgs__msg__String__Storage string_received_2_storage;
static rcl_timer_t timer_0;
static rclc_executor_t executor;
static uint32_t failed;
static uint32_t ticks; /* of timers; without timers: of EXAMPLE_PERIOD_MS */

static void on_timer_0(rcl_timer_t * timer, int64_t since_last_call);
static void on_int32_received_1(const void * message);
static void on_string_received_2(const void * message);

static rcl_ret_t executors_init(rcl_allocator_t * allocator)
{
  rcl_ret_t result = RCL_RET_OK;

  if (result == RCL_RET_OK) {
    result = rclc_timer_init_default2(&timer_0, &support, RCL_MS_TO_NS(1000), on_timer_0, true);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 3, allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_timer(&executor, &timer_0);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_subscription(
      &executor, &subscription_1, &int32_received_1, on_int32_received_1, ON_NEW_DATA);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_subscription(
      &executor, &subscription_2, &string_received_2, on_string_received_2, ON_NEW_DATA);
  }
  return result;
}

static rcl_ret_t application_init(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "probe", "", &support);
  }
  if (result == RCL_RET_OK) {
    rmw_qos_profile_t qos = rmw_qos_profile_default;

    qos.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
    result = rclc_subscription_init(
      &subscription_1, &node,
      ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "heard", &qos);
  }
  if (result == RCL_RET_OK) {
    result = rclc_subscription_init_default(
      &subscription_2, &node,
      ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "said");
  }
  if (result == RCL_RET_OK && !std_msgs__msg__Int32__init(&int32_received_1)) {
    result = RCL_RET_ERROR;
  }
  std_msgs__msg__String__bind(&string_received_2, &string_received_2_storage);
  return result == RCL_RET_OK ? executors_init(&allocator) : result;
}

static void application_fini(void)
{
  (void)rclc_executor_fini(&executor);
  (void)rcl_timer_fini(&timer_0);
  (void)rcl_subscription_fini(&subscription_2, &node);
  (void)rcl_subscription_fini(&subscription_1, &node);
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

/* Reports why a call failed: the library keeps the text of the last error. */
static void report(const char * what)
{
  (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
  rcl_reset_error();
}

/* `message` is valid until the callback returns. */
static void on_int32_received_1(const void * message)
{
  const std_msgs__msg__Int32 * const received = (const std_msgs__msg__Int32 *)message;

  (void)printf("heard: %lld\n", (long long)received->data);
  (void)fflush(stdout);
}

/* `message` is valid until the callback returns. */
static void on_string_received_2(const void * message)
{
  const std_msgs__msg__String * const received = (const std_msgs__msg__String *)message;

  (void)printf("said: %s\n", received->data.data);
  (void)fflush(stdout);
}

/* The timer tick. */
static void on_timer_0(rcl_timer_t * timer, int64_t since_last_call)
{
  (void)timer;
  (void)since_last_call; /* nanoseconds */
  ++ticks;
}

int main(void)
{
  if (application_init() != RCL_RET_OK) {
    report("start");
    application_fini();
    return 1;
  }
  while (ticks < EXAMPLE_SAMPLES) {
    if (rclc_executor_spin_some(&executor, executor.timeout_ns) != RCL_RET_OK) {
      report("executor");
      ++failed;
    }
  }
  application_fini();
  return failed == 0 ? 0 : 1;
}
