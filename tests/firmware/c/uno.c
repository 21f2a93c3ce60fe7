/* SPDX-License-Identifier: Apache-2.0 */
/* For an Arduino: publishes the last number of /led on /count, and starts again when the agent is not there. */
#include <rcl/error_handling.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int16.h>
#include <std_msgs/msg/int32.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rcl_timer_t timer;
static rclc_executor_t executor;
static std_msgs__msg__Int16 received;
static std_msgs__msg__Int32 sent;

static void on_led(const void * untyped)
{
  const std_msgs__msg__Int16 * message = untyped;

  sent.data = message->data;
}

static void on_timer(rcl_timer_t * ended, int64_t since_ns)
{
  (void)since_ns;
  if (ended != NULL && rcl_publish(&publisher, &sent, NULL) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

static rcl_ret_t start(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  result = result == RCL_RET_OK ? rclc_node_init_default(&node, "uno", "", &support) : result;
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
  }
  if (result == RCL_RET_OK) {
    result = rclc_subscription_init_default(
      &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int16), "led");
  }
  result = result == RCL_RET_OK
             ? rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(100), on_timer, true)
             : result;
  result = result == RCL_RET_OK ? rclc_executor_init(&executor, &support.context, 2, &allocator) : result;
  result = result == RCL_RET_OK
             ? rclc_executor_add_subscription(&executor, &subscription, &received, on_led, ON_NEW_DATA)
             : result;
  return result == RCL_RET_OK ? rclc_executor_add_timer(&executor, &timer) : result;
}

int main(void)
{
  if (start() != RCL_RET_OK) {
    return 1; /* the board restarts after a second */
  }
  return rclc_executor_spin(&executor) == RCL_RET_OK ? 0 : 1;
}
