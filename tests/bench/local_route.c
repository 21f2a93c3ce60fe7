/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node that hears itself: publishes COUNT messages, each after the callback of the one before. Whether they go through
 * the image or over the agent is a matter of the application file. Prints the ns of processor time of a message. */
#define _POSIX_C_SOURCE 200809L
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MEETING_ROUNDS = 20, DECIMAL = 10 };

static long heard;

static void on_message(const void * message)
{
  (void)message;
  ++heard;
}

static void check(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    exit(1);
  }
}

static long long spent_ns(void)
{
  struct timespec spent;

  (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &spent);
  return (long long)spent.tv_sec * 1000000000 + spent.tv_nsec;
}

int main(int count, char ** words)
{
  const long messages = count > 1 ? strtol(words[1], NULL, DECIMAL) : 1;
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  std_msgs__msg__Int32 message = {.data = 0};
  std_msgs__msg__Int32 taken;
  long long begun;

  check(rclc_support_init(&support, 0, NULL, &allocator));
  check(rclc_node_init_default(&node, "device", "", &support));
  check(rclc_publisher_init_default(&publisher, &node, type, "count"));
  check(rclc_subscription_init_default(&subscription, &node, type, "count"));
  check(rclc_executor_init(&executor, &support.context, 1, &allocator));
  check(rclc_executor_add_subscription(&executor, &subscription, &taken, on_message, ON_NEW_DATA));
  for (int i = 0; i < MEETING_ROUNDS; ++i) { /* the two ends find each other in DDS */
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)));
  }
  begun = spent_ns();
  for (message.data = 0; message.data < messages; ++message.data) {
    check(rcl_publish(&publisher, &message, NULL));
    while (heard <= message.data) {
      check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(1000)));
    }
  }
  (void)printf("%lld\n", (spent_ns() - begun) / messages);
  return 0;
}
