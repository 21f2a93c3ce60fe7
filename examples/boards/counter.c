/* SPDX-License-Identifier: Apache-2.0 */
#include "counter.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rclc/sleep.h>
#include <std_msgs/msg/int32.h>

enum { PERIOD_MS = 100 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static std_msgs__msg__Int32 count;

static void counter_publish(void)
{
  for (;;) {
    if (rcl_publish(&publisher, &count, NULL) == RCL_RET_OK) {
      ++count.data;
    }
    rclc_sleep_ms(PERIOD_MS);
  }
}

void counter_run(void)
{
  const rosidl_message_type_support_t * const type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  if (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    return;
  }
  if (rclc_node_init_default(&node, "counter", "", &support) == RCL_RET_OK) {
    if (rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK) {
      counter_publish();
    }
    (void)rcl_node_fini(&node);
  }
  (void)rclc_support_fini(&support);
}
