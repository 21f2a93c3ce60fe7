/* SPDX-License-Identifier: Apache-2.0 */
/* A timer publishes a number that goes up. */
#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <inttypes.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_timer_t timer;
static rclc_executor_t executor;
static std_msgs__msg__Int32 count;

static void publish_count(rcl_timer_t * due, int64_t last_call_time)
{
  RCLC_UNUSED(due);
  RCLC_UNUSED(last_call_time);
  if (example_tell(rcl_publish(&publisher, &count, NULL), "publish")) {
    (void)printf("published %" PRId32 "\n", count.data);
    ++count.data;
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "counter", "", &support), "node");
  example_check(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count"),
    "publisher");
  example_check(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(100), publish_count, true), "timer");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  example_check(rclc_executor_add_timer(&executor, &timer), "add timer");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_timer_fini(&timer), "end of the timer");
  example_check(rcl_publisher_fini(&publisher, &node), "end of the publisher");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
