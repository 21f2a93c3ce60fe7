/* SPDX-License-Identifier: Apache-2.0 */
/* An ordinary application of rclc: a timer publishes on `count`, and the executor spins forever. With TICKER_LISTENS it
 * goes on from the number that came last on `numbers`. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#ifndef TICKER_PERIOD_MS
#define TICKER_PERIOD_MS 100
#endif

#define CHECK(call) \
  if ((call) != RCL_RET_OK) { \
    return 1; \
  }

static rcl_publisher_t publisher;
static std_msgs__msg__Int32 message;
volatile uint32_t ticker_calls;
#ifdef TICKER_LISTENS
static rcl_subscription_t subscription;
static std_msgs__msg__Int32 received;

static void subscription_callback(const void * number)
{
  message.data = ((const std_msgs__msg__Int32 *)number)->data;
}
#endif

static void timer_callback(rcl_timer_t * timer, int64_t last_call_time)
{
  RCLC_UNUSED(last_call_time);
  if (timer != NULL && rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
    message.data++;
  }
  ticker_calls = ticker_calls + 1u;
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node;
  rcl_timer_t timer;
  rclc_executor_t executor;

  CHECK(rclc_support_init(&support, 0, NULL, &allocator));
  CHECK(rclc_node_init_default(&node, "ticker", "", &support));
  CHECK(rclc_publisher_init_default(
    &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count"));
  CHECK(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(TICKER_PERIOD_MS), timer_callback, true));
#ifdef TICKER_LISTENS
  CHECK(rclc_subscription_init_default(
    &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "numbers"));
#endif
  executor = rclc_executor_get_zero_initialized_executor();
  CHECK(rclc_executor_init(&executor, &support.context, 2, &allocator));
  CHECK(rclc_executor_add_timer(&executor, &timer));
#ifdef TICKER_LISTENS
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &received, subscription_callback, ON_NEW_DATA));
#endif
  CHECK(rclc_executor_spin(&executor));
#ifdef TICKER_LISTENS
  CHECK(rcl_subscription_fini(&subscription, &node));
#endif
  CHECK(rcl_publisher_fini(&publisher, &node));
  CHECK(rcl_node_fini(&node));
  return 0;
}
