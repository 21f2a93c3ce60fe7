/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Two sensors, and a result for each pair of their values: the trigger lets the executor take messages only when both
 * subscriptions have one. What comes earlier waits in its queue. The callbacks run in the order in which they were added.
 */
#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

typedef struct {
  rcl_publisher_t publisher;
  std_msgs__msg__Int32 left; /* of the pair that is being handled */
} pairing_t;

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t left;
static rcl_subscription_t right;
static rclc_executor_t executor;
static std_msgs__msg__Int32 left_message;
static std_msgs__msg__Int32 right_message;
static pairing_t pairing;

static void keep_left(const void * message, void * context)
{
  pairing_t * pair = context;

  pair->left = *(const std_msgs__msg__Int32 *)message;
}

static void publish_difference(const void * message, void * context)
{
  const pairing_t * pair = context;
  const std_msgs__msg__Int32 * received = message;
  const std_msgs__msg__Int32 difference = {pair->left.data - received->data};

  (void)example_tell(rcl_publish(&pair->publisher, &difference, NULL), "publish");
}

int main(void)
{
  const rosidl_message_type_support_t * int32 = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "pairing", "", &support), "node");
  example_check(rclc_publisher_init_default(&pairing.publisher, &node, int32, "difference"), "publisher");
  example_check(rclc_subscription_init_default(&left, &node, int32, "left"), "left");
  example_check(rclc_subscription_init_default(&right, &node, int32, "right"), "right");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 2, &allocator), "executor");
  example_check(
    rclc_executor_add_subscription_with_context(
      &executor, &left, &left_message, keep_left, &pairing, ON_NEW_DATA),
    "add left");
  example_check(
    rclc_executor_add_subscription_with_context(
      &executor, &right, &right_message, publish_difference, &pairing, ON_NEW_DATA),
    "add right");
  example_check(rclc_executor_set_trigger(&executor, rclc_executor_trigger_all, NULL), "trigger");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_subscription_fini(&right, &node), "end of right");
  example_check(rcl_subscription_fini(&left, &node), "end of left");
  example_check(rcl_publisher_fini(&pairing.publisher, &node), "end of the publisher");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
