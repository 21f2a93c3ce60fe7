/*
 * An application for static_configured_sender, to start from: copy it out of this folder and change it.
 * It publishes std_msgs/msg/Int32 on fast, std_msgs/msg/Header on sure every EXAMPLE_PERIOD_MS milliseconds.
 */
#include <microros/port.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rosidl_runtime_c/string.h>
#include <std_msgs/msg/detail/header__storage.h>
#include <std_msgs/msg/header.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#ifndef EXAMPLE_PERIOD_MS
#define EXAMPLE_PERIOD_MS 100
#endif

/* Number of samples before the program ends: by default enough for years. */
#ifndef EXAMPLE_SAMPLES
#define EXAMPLE_SAMPLES UINT32_MAX
#endif

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher_0;
static std_msgs__msg__Int32 int32_0;
static rcl_publisher_t publisher_1;
static std_msgs__msg__Header header_1;
static std_msgs__msg__Header__Storage header_1_storage;

/* Copies into the storage that the message is bound to. rosidl_runtime_c__String__assign does that, too,
 * but links further storage for longer texts, which a bound message does not need. */
static bool put_text(rosidl_runtime_c__String * string, const char * text)
{
  const size_t size = strlen(text);

  if (size >= string->capacity) {
    return false;
  }
  (void)memcpy(string->data, text, size + 1u);
  string->size = size;
  return true;
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
    result = rclc_publisher_init(
      &publisher_0, &node,
      ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "fast", &qos);
  }
  if (result == RCL_RET_OK) {
    rmw_qos_profile_t qos = rmw_qos_profile_default;

    qos.depth = 5;
    result = rclc_publisher_init(
      &publisher_1, &node,
      ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Header), "sure", &qos);
  }
  if (result == RCL_RET_OK && !std_msgs__msg__Int32__init(&int32_0)) {
    result = RCL_RET_ERROR;
  }
  std_msgs__msg__Header__bind(&header_1, &header_1_storage);
  if (
    result == RCL_RET_OK &&
    !put_text(&header_1.frame_id, "probe")) {
    result = RCL_RET_ERROR;
  }
  return result;
}

static void application_fini(void)
{
  (void)rcl_publisher_fini(&publisher_1, &node);
  (void)rcl_publisher_fini(&publisher_0, &node);
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

static rcl_ret_t publish_int32_0(uint32_t count)
{
  int32_0.data = (int32_t)count;
  return rcl_publish(&publisher_0, &int32_0, NULL);
}

static rcl_ret_t publish_header_1(uint32_t count)
{
  const int64_t now_ns = port_time_epoch_ns();

  header_1.stamp.sec = (int32_t)(now_ns / 1000000000);
  header_1.stamp.nanosec = (uint32_t)(now_ns % 1000000000);
  (void)count;
  return rcl_publish(&publisher_1, &header_1, NULL);
}

/* Reports why a call failed: the library keeps the text of the last error. */
static void report(const char * what)
{
  (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
  rcl_reset_error();
}

int main(void)
{
  uint32_t failed = 0;

  if (application_init() != RCL_RET_OK) {
    report("start");
    application_fini();
    return 1;
  }
  for (uint32_t count = 0; count < EXAMPLE_SAMPLES; ++count) {
    if (publish_int32_0(count) != RCL_RET_OK) {
      report("fast");
      ++failed;
    }
    if (publish_header_1(count) != RCL_RET_OK) {
      report("sure");
      ++failed;
    }
    rclc_sleep_ms(EXAMPLE_PERIOD_MS);
  }
  application_fini();
  return failed == 0 ? 0 : 1;
}
