/*
 * An application for ad_hoc_discoverable_sender, to start from: copy it out of this folder and change it.
 * It publishes std_msgs/msg/Int32 on int32 every EXAMPLE_PERIOD_MS milliseconds.
 */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdint.h>
#include <stdio.h>

#ifndef EXAMPLE_PERIOD_MS
#define EXAMPLE_PERIOD_MS 100
#endif

/* How often it does so before it ends: here, for years. */
#ifndef EXAMPLE_SAMPLES
#define EXAMPLE_SAMPLES UINT32_MAX
#endif

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher_0;
static std_msgs__msg__Int32 int32_0;

static rcl_ret_t application_init(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "ad_hoc_discoverable_sender", "", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &publisher_0, &node,
      ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "int32");
  }
  if (result == RCL_RET_OK && !std_msgs__msg__Int32__init(&int32_0)) {
    result = RCL_RET_ERROR;
  }
  return result;
}

static void application_fini(void)
{
  (void)rcl_publisher_fini(&publisher_0, &node);
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

static rcl_ret_t publish_int32_0(uint32_t count)
{
  int32_0.data = (int32_t)count;
  return rcl_publish(&publisher_0, &int32_0, NULL);
}

/* Why a call failed: the library keeps the text of the last error. */
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
      report("int32");
      ++failed;
    }
    rclc_sleep_ms(EXAMPLE_PERIOD_MS);
  }
  application_fini();
  return failed == 0 ? 0 : 1;
}
