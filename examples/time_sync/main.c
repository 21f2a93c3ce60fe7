/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A device without its own clock stamps its messages with the agent's time. It asks again from time to time, since
 * the crystal of the board and the clock of the agent's machine drift apart.
 */
#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rclc/sleep.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/header.h>

enum { ASK_AGAIN = 600, TIMEOUT_MS = 1000 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;

static void ask_time(void)
{
  if (rmw_uros_sync_session(TIMEOUT_MS) != RMW_RET_OK) {
    /* What it answered last time holds on. */
    (void)fprintf(stderr, "the agent did not say what time it is\n");
  }
}

int main(void)
{
  static char frame[] = "board";
  std_msgs__msg__Header header = {.frame_id = {frame, sizeof(frame) - 1u, sizeof(frame)}};
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "stamper", "", &support), "node");
  example_check(
    rclc_publisher_init_best_effort(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Header), "stamps"),
    "publisher");
  for (unsigned long i = 0; example_runs(); ++i) {
    if (i % ASK_AGAIN == 0) {
      ask_time();
    }
    if (rmw_uros_epoch_synchronized()) {
      const int64_t now = rmw_uros_epoch_nanos();

      header.stamp.sec = (int32_t)RCL_NS_TO_S(now);
      header.stamp.nanosec = (uint32_t)(now % RCL_S_TO_NS(1));
      (void)example_tell(rcl_publish(&publisher, &header, NULL), "publish");
    }
    rclc_sleep_ms(100);
  }
  example_check(rcl_publisher_fini(&publisher, &node), "end of the publisher");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
