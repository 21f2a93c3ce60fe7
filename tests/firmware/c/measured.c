/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The measured program: opens a session, a node and a publisher of Int32 (BENCH_INIT is the function that opens it),
 * and publishes.
 */
#include "measured.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

enum { SAMPLES = 32 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static std_msgs__msg__Int32 message;

static rcl_ret_t start(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "bench", "", &support);
  }
  if (result == RCL_RET_OK) {
    result = BENCH_INIT(&publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count");
  }
  return result;
}

int main(void)
{
  mark();
  mark(); /* the distance of these two is the cost of a mark */
  if (start() != RCL_RET_OK) {
    finish();
  }
  mark();
  for (int32_t i = 0; i < SAMPLES; ++i) {
    message.data = i;
    if (rcl_publish(&publisher, &message, NULL) != RCL_RET_OK) {
      finish();
    }
    mark();
  }
  finish();
  return 0;
}
