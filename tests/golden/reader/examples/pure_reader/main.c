/*
 * An application for pure_reader, to start from: copy it out of this folder and change it.
 * It has an executor take std_msgs/msg/Int32 on heard, std_msgs/msg/String on said.
 */
#include <microros/port.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/detail/string__storage.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>

#include <stdint.h>
#include <stdio.h>

#ifndef EXAMPLE_PERIOD_MS
#define EXAMPLE_PERIOD_MS 100
#endif

/* Number of samples before the program ends: by default enough for years. */
#ifndef EXAMPLE_SAMPLES
#define EXAMPLE_SAMPLES UINT32_MAX
#endif

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription_0;
static std_msgs__msg__Int32 int32_received_0;
static rcl_subscription_t subscription_1;
static std_msgs__msg__String string_received_1;
static std_msgs__msg__String__Storage string_received_1_storage;
static rclc_executor_t executor;
static uint32_t failed;
static uint32_t ticks; /* of timers; without timers: of EXAMPLE_PERIOD_MS */

static void on_int32_received_0(const void * message);
static void on_string_received_1(const void * message);

static rcl_ret_t executors_init(rcl_allocator_t * allocator)
{
  rcl_ret_t result = RCL_RET_OK;

  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 2, allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_subscription(
      &executor, &subscription_0, &int32_received_0, on_int32_received_0, ON_NEW_DATA);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_add_subscription(
      &executor, &subscription_1, &string_received_1, on_string_received_1, ON_NEW_DATA);
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
      &subscription_0, &node,
      ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "heard", &qos);
  }
  if (result == RCL_RET_OK) {
    result = rclc_subscription_init_default(
      &subscription_1, &node,
      ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "said");
  }
  if (result == RCL_RET_OK && !std_msgs__msg__Int32__init(&int32_received_0)) {
    result = RCL_RET_ERROR;
  }
  std_msgs__msg__String__bind(&string_received_1, &string_received_1_storage);
  return result == RCL_RET_OK ? executors_init(&allocator) : result;
}

static void application_fini(void)
{
  (void)rclc_executor_fini(&executor);
  (void)rcl_subscription_fini(&subscription_1, &node);
  (void)rcl_subscription_fini(&subscription_0, &node);
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
static void on_int32_received_0(const void * message)
{
  const std_msgs__msg__Int32 * const received = (const std_msgs__msg__Int32 *)message;

  (void)printf("heard: %lld\n", (long long)received->data);
  (void)fflush(stdout);
}

/* `message` is valid until the callback returns. */
static void on_string_received_1(const void * message)
{
  const std_msgs__msg__String * const received = (const std_msgs__msg__String *)message;

  (void)printf("said: %s\n", received->data.data);
  (void)fflush(stdout);
}

/* Runs the executors for EXAMPLE_PERIOD_MS. */
static void run(void)
{
  const uint32_t begin = port_time_ms();
  uint32_t passed = 0;

  while (passed < EXAMPLE_PERIOD_MS) {
    if (rclc_executor_spin_some(&executor, (uint64_t)(EXAMPLE_PERIOD_MS - passed) * 1000000u) != RCL_RET_OK) {
      report("executor");
      ++failed;
    }
    passed = port_time_ms() - begin;
  }
}

int main(void)
{
  if (application_init() != RCL_RET_OK) {
    report("start");
    application_fini();
    return 1;
  }
  for (; ticks < EXAMPLE_SAMPLES; ++ticks) {
    run();
  }
  application_fini();
  return failed == 0 ? 0 : 1;
}
