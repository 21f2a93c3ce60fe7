/* SPDX-License-Identifier: Apache-2.0 */
/* Prints the numbers that come. */
#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription;
static rclc_executor_t executor;
static std_msgs__msg__Int32 number;

static void print_number(const void * message)
{
  const std_msgs__msg__Int32 * received = message;

  (void)printf("received %" PRId32 "\n", received->data);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "listener", "", &support), "node");
  example_check(
    rclc_subscription_init_default(
      &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "numbers"),
    "subscription");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  example_check(
    rclc_executor_add_subscription(&executor, &subscription, &number, print_number, ON_NEW_DATA),
    "add subscription");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_subscription_fini(&subscription, &node), "end of the subscription");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
