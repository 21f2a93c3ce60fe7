/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Stop the agent and start it again: the numbers go on, and orders are received again. No line here does that; the library
 * finds the agent and creates the node and its entities again. A callback reports each change.
 */
#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rcl_timer_t timer;
static rclc_executor_t executor;
static std_msgs__msg__Int32 count;
static std_msgs__msg__Int32 order;

/* The only call that the existing micro-ROS does not have; leave it out, and everything else goes on as it does. */
static void tell_state(const rmw_uros_session_event_t * event, void * argument)
{
  RCLC_UNUSED(argument);
  if (event->state == RMW_UROS_SESSION_LOST) {
    (void)printf("the agent is gone\n");
  } else if (event->state == RMW_UROS_SESSION_CONNECTED) {
    (void)printf("connected, %" PRIu32 " times again\n", event->reconnects);
  }
}

static void publish_count(rcl_timer_t * due, int64_t last_call_time)
{
  RCLC_UNUSED(due);
  RCLC_UNUSED(last_call_time);
  ++count.data;
  (void)example_tell(rcl_publish(&publisher, &count, NULL), "publish");
}

static void print_order(const void * message)
{
  const std_msgs__msg__Int32 * received = message;

  (void)printf("order %" PRId32 "\n", received->data);
}

int main(void)
{
  const rosidl_message_type_support_t * int32 = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rmw_uros_set_session_callback(tell_state, NULL), "session callback");
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "survivor", "", &support), "node");
  example_check(rclc_publisher_init_default(&publisher, &node, int32, "alive"), "publisher");
  example_check(rclc_subscription_init_default(&subscription, &node, int32, "orders"), "subscription");
  example_check(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(50), publish_count, true), "timer");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 2, &allocator), "executor");
  example_check(rclc_executor_add_timer(&executor, &timer), "add timer");
  example_check(
    rclc_executor_add_subscription(&executor, &subscription, &order, print_order, ON_NEW_DATA),
    "add subscription");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_timer_fini(&timer), "end of the timer");
  example_check(rcl_subscription_fini(&subscription, &node), "end of the subscription");
  example_check(rcl_publisher_fini(&publisher, &node), "end of the publisher");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
