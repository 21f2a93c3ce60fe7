/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes 0, 1, … and takes numbers meanwhile, until a negative one arrives; prints each number that it takes. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { PERIOD_MS = 5, DEPTH = 1000 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription;
static rcl_publisher_t publisher;
static std_msgs__msg__Int32 taken;
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
  const int32_t number = ((const std_msgs__msg__Int32 *)message)->data;

  (void)printf("taken %" PRId32 "\n", number);
  (void)fflush(stdout);
  done = number < 0;
}

int main(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  std_msgs__msg__Int32 next = {0};

  qos.depth = DEPTH;
  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "", &support), "node");
  check(rclc_publisher_init(&publisher, &node, type, "rolling_up", &qos), "publisher");
  check(rclc_subscription_init(&subscription, &node, type, "rolling_down", &qos), "subscription");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  check(rclc_executor_add_subscription(&executor, &subscription, &taken, on_number, ON_NEW_DATA), "add");
  while (!done) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(PERIOD_MS));
    if (rcl_publish(&publisher, &next, NULL) == RCL_RET_OK) {
      ++next.data; /* a full stream, or no session: the next attempt sends the same number */
    }
    rcl_reset_error();
    rclc_sleep_ms(PERIOD_MS);
  }
  check(rcl_publisher_wait_for_all_acked(&publisher, RCL_S_TO_NS(30)), "flush");
  (void)printf("published %" PRId32 "\n", next.data);
  return 0;
}
