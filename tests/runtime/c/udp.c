/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes 0 to 99 over the POSIX port; a value that the stream does not take is tried again. */
#include "types.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <stdio.h>

enum { VALUES = 100, TRIES = 2000 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;

static int fail(int code)
{
  printf("%s\n", rcl_get_error_string().str);
  return code;
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  std_msgs__msg__Int32 message = {0};
  int tries = 0;

  if (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    return fail(2);
  }
  if (
    rclc_node_init_default(&node, "talker", "", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "chatter") != RCL_RET_OK) {
    return fail(3);
  }
  while (message.data < VALUES && tries < TRIES) {
    if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
      ++message.data;
    } else {
      ++tries;
    }
    rclc_sleep_ms(2);
  }
  if (tries == TRIES || rmw_uros_flush(rcl_context_get_rmw_context(&support.context), 3000) != RMW_RET_OK) {
    return fail(4);
  }
  if (
    rcl_publisher_fini(&publisher, &node) != RCL_RET_OK || rcl_node_fini(&node) != RCL_RET_OK ||
    rclc_support_fini(&support) != RCL_RET_OK) {
    return fail(5);
  }
  return 0;
}
