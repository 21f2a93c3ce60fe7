/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Blinks three times, pauses, and begins again: a slow timer starts a fast one, which ends itself after its third call.
 * From the third burst on the pauses are shorter. What it would switch on a board it publishes here: 1, 2, 3, 1, 2, 3, …
 */
#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

enum { BLINKS = 3, LONG_PAUSES = 2 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_timer_t pause_timer;
static rcl_timer_t blink_timer;
static rclc_executor_t executor;
static std_msgs__msg__Int32 blinks;
static int bursts;

static void blink(rcl_timer_t * timer, int64_t last_call_time)
{
  RCLC_UNUSED(last_call_time);
  ++blinks.data;
  (void)example_tell(rcl_publish(&publisher, &blinks, NULL), "publish");
  if (blinks.data == BLINKS) {
    (void)example_tell(rcl_timer_cancel(timer), "cancel");
  }
}

static void begin_burst(rcl_timer_t * timer, int64_t last_call_time)
{
  bool is_over = false;
  int64_t old_period = 0;

  RCLC_UNUSED(last_call_time);
  if (!example_tell(rcl_timer_is_canceled(&blink_timer, &is_over), "blinks") || !is_over) {
    return;
  }
  blinks.data = 0;
  (void)example_tell(rcl_timer_reset(&blink_timer), "reset");
  if (++bursts == LONG_PAUSES) {
    (void)example_tell(rcl_timer_exchange_period(timer, RCL_MS_TO_NS(100), &old_period), "period");
    (void)printf("pauses: %d ms, were %d ms\n", 100, (int)RCL_NS_TO_MS(old_period));
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "blinker", "", &support), "node");
  example_check(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "blinks"),
    "publisher");
  example_check(
    rclc_timer_init_default2(&pause_timer, &support, RCL_MS_TO_NS(250), begin_burst, true), "pause");
  example_check(
    rclc_timer_init_default2(&blink_timer, &support, RCL_MS_TO_NS(20), blink, false),
    "blink"); /* without autostart: it waits for rcl_timer_reset */

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 2, &allocator), "executor");
  example_check(rclc_executor_add_timer(&executor, &pause_timer), "add pause");
  example_check(rclc_executor_add_timer(&executor, &blink_timer), "add blink");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_timer_fini(&blink_timer), "end of blink");
  example_check(rcl_timer_fini(&pause_timer), "end of pause");
  example_check(rcl_publisher_fini(&publisher, &node), "end of the publisher");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
