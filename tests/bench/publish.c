/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes Int32 under callgrind; argv[1] says on which stream (see instructions.py). */
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { PUBLISHES = 200 };

static int publish_all(bool reliable)
{
  static rclc_support_t context;
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  static std_msgs__msg__Int32 message;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  int accepted = 0;
  rcl_ret_t result = rclc_support_init(&context, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "bench", "", &context);
  }
  if (result == RCL_RET_OK && reliable) {
    result = rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "reliable");
  } else if (result == RCL_RET_OK) {
    result = rclc_publisher_init_best_effort(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "best_effort");
  }
  if (result != RCL_RET_OK) {
    fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 1;
  }
  while (accepted < PUBLISHES) {
    ++message.data;
    if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
      ++accepted;
    } else {
      rcl_reset_error();
    }
    rclc_sleep_ms(2); /* the acknowledgement comes meanwhile: the stream has room */
  }
  printf("%d calls\n", accepted);
  return 0;
}

int main(int argc, char ** argv)
{
  if (argc != 2) {
    return 2;
  }
  return publish_all(strcmp(argv[1], "reliable") == 0);
}
