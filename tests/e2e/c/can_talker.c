/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Counts on a topic over CAN FD until its input ends, and says how far. Arguments: device, identifier, client key,
 * topic. */
#define _POSIX_C_SOURCE 200809L
#include <rcl/error_handling.h>
#include <rcl/init_options.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void refuse(rcl_ret_t result, const char * what)
{
  if (result != RMW_RET_INVALID_ARGUMENT) {
    (void)fprintf(stderr, "%s: accepted\n", what);
    exit(1);
  }
  rcl_reset_error();
}

static void begin_session(char ** argv, rcl_allocator_t * allocator)
{
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  const uint32_t id = (uint32_t)strtoul(argv[2], NULL, 0);
  rcl_ret_t result = RCL_RET_TIMEOUT;
  rmw_init_options_t * rmw_options;

  check(rcl_init_options_init(&options, *allocator), "options");
  rmw_options = rcl_init_options_get_rmw_init_options(&options);
  refuse(rmw_uros_options_set_can_device("", id, rmw_options), "no name");
  refuse(rmw_uros_options_set_can_device(argv[1], 0, rmw_options), "no identifier");
  refuse(rmw_uros_options_set_can_device(argv[1], 0x20000000, rmw_options), "30 bits");
  check(rmw_uros_options_set_can_device(argv[1], id, rmw_options), "device");
  check(rmw_uros_options_set_client_key((uint32_t)strtoul(argv[3], NULL, 0), rmw_options), "key");
  for (int i = 0; i < 20 && result == RCL_RET_TIMEOUT; ++i) {
    rcl_reset_error();
    result = rclc_support_init_with_options(&support, 0, NULL, &options, allocator);
  }
  check(result, "init");
}

int main(int argc, char ** argv)
{
  struct pollfd input = {0, POLLIN, 0};
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_uros_statistics_t counted;
  std_msgs__msg__Int32 number = {0};

  if (argc != 5) {
    return 2;
  }
  begin_session(argv, &allocator);
  check(rclc_node_init_default(&node, argv[4], "", &support), "node");
  check(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), argv[4]),
    "publisher");
  while (poll(&input, 1, 10) == 0) {
    ++number.data;
    check(rcl_publish(&publisher, &number, NULL), "publish");
  }
  check(rcl_publisher_wait_for_all_acked(&publisher, RCL_S_TO_NS(30)), "flush");
  check(rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &counted), "statistics");
  (void)printf(
    "last=%" PRId32 " malformed=%" PRIu32 " reconnects=%" PRIu32 "\n", number.data, counted.malformed,
    counted.reconnects);
  check(rclc_support_fini(&support), "fini");
  return 0;
}
