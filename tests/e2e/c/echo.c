/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes what it takes, and says at the end what the session went through. Arguments: the last number. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription;
static rcl_publisher_t publisher;
static std_msgs__msg__Int32 number;
static int32_t last;
static bool done;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void on_number(const void * message)
{
  const std_msgs__msg__Int32 * taken = message;

  check(rcl_publish(&publisher, taken, NULL), "publish");
  done = taken->data == last;
}

/* For as long as it takes on a bad network. */
static void begin_session(rcl_allocator_t * allocator)
{
  rcl_ret_t result = RCL_RET_TIMEOUT;

  for (int i = 0; i < 20 && result == RCL_RET_TIMEOUT; ++i) {
    rcl_reset_error();
    result = rclc_support_init(&support, 0, NULL, allocator);
  }
  check(result, "init");
  check(
    rmw_uros_set_context_entity_creation_session_timeout(
      rcl_context_get_rmw_context(&support.context), 20000),
    "timeout");
}

int main(int argc, char ** argv)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  rmw_uros_statistics_t counted;

  last = argc > 1 ? (int32_t)strtol(argv[1], NULL, 10) : 0;
  qos.depth = 1000; /* what waits for room here waits at the agent */
  begin_session(&allocator);
  check(rclc_node_init_default(&node, "echo", "", &support), "node");
  check(rclc_publisher_init(&publisher, &node, type, "echo_out", &qos), "publisher");
  check(rclc_subscription_init(&subscription, &node, type, "echo_in", &qos), "subscription");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  check(rclc_executor_add_subscription(&executor, &subscription, &number, on_number, ON_NEW_DATA), "add");
  while (!done) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100));
  }
  check(rcl_publisher_wait_for_all_acked(&publisher, RCL_S_TO_NS(30)), "flush");
  check(rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &counted), "statistics");
  (void)printf(
    "sent=%" PRIu32 " resent=%" PRIu32 " received=%" PRIu32 " malformed=%" PRIu32 " dropped=%" PRIu32
    " reconnects=%" PRIu32 "\n",
    counted.sent, counted.resent, counted.received, counted.malformed, counted.dropped, counted.reconnects);
  return 0;
}
