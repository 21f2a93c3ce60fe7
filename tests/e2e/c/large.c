/* SPDX-License-Identifier: Apache-2.0 */
/*
 * large PORT COUNT: publishes COUNT strings of about 20 KiB on the declared topic, one after the other and none left out,
 * waits until the agent has them, and prints how many messages went out and how many of them again.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/string.h>

enum { SIZE = 20480, ATTEMPTS = 20000, FLUSH_MS = 20000 };

static rclc_support_t support;
static rcl_init_options_t options;
static rcl_node_t node;
static rcl_publisher_t publisher;
static std_msgs__msg__String message;
static char text[SIZE + 1];

static rcl_ret_t set_up(const char * port)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rcl_ret_t result;

  options = rcl_get_zero_initialized_init_options();
  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  result = rcl_init_options_init(&options, allocator);
  if (result == RCL_RET_OK) {
    result =
      rmw_uros_options_set_udp_address("127.0.0.1", port, rcl_init_options_get_rmw_init_options(&options));
  }
  if (result == RCL_RET_OK) {
    result = rclc_support_init_with_options(&support, 0, NULL, &options, &allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "big", LARGE_NAMESPACE, &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "blob", &qos);
  }
  return result;
}

/* Sample i has SIZE - i characters, which follow from i and their place. */
static rcl_ret_t send(int i, rmw_context_t * context)
{
  rcl_ret_t result = RCL_RET_ERROR;

  for (int k = 0; k < SIZE - i; ++k) {
    text[k] = (char)('a' + (i + k + k / 97) % 26);
  }
  text[SIZE - i] = '\0';
  message.data.data = text;
  message.data.size = (size_t)(SIZE - i);
  message.data.capacity = SIZE + 1;
  for (int attempt = 0; attempt < ATTEMPTS && result != RCL_RET_OK; ++attempt) {
    rcl_reset_error();
    result = rcl_publish(&publisher, &message, NULL);
    if (result != RCL_RET_OK && rmw_uros_spin_once(context) != RMW_RET_OK) {
      return RCL_RET_ERROR;
    }
    rclc_sleep_ms(1);
  }
  return result;
}

int main(int count, char ** arguments)
{
  rmw_uros_statistics_t statistics;
  rmw_context_t * context;

  if (count != 3 || set_up(arguments[1]) != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 1;
  }
  context = rcl_context_get_rmw_context(&support.context);
  for (int i = 0; i < atoi(arguments[2]); ++i) {
    if (send(i, context) != RCL_RET_OK) {
      (void)fprintf(stderr, "sample %d: %s\n", i, rcl_get_error_string().str);
      return 1;
    }
  }
  if (
    rmw_uros_flush(context, FLUSH_MS) != RMW_RET_OK ||
    rmw_uros_get_statistics(context, &statistics) != RMW_RET_OK) {
    (void)fprintf(stderr, "not all is acknowledged\n");
    return 1;
  }
  printf("%u %u\n", (unsigned)statistics.sent, (unsigned)statistics.resent);
  return getchar() != '\n' || rcl_publisher_fini(&publisher, &node) != RCL_RET_OK ||
         rcl_node_fini(&node) != RCL_RET_OK || rclc_support_fini(&support) != RCL_RET_OK;
}
