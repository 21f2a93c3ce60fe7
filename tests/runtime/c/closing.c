/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Publishes until the line takes no more, and closes: prints "ready", and after a line on standard input how many values were
 * taken, from 0 up, and then how many milliseconds the end of the session took.
 */
#include "types.h"

#include <microros/port.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>

#include <stdio.h>

enum { MOST = 10000, REFUSED = 100 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  std_msgs__msg__Int32 message = {0};
  char line[8];
  uint32_t start;
  int refused = 0;

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "talker", "", &support) != RCL_RET_OK ||
    rclc_publisher_init_best_effort(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "chatter") != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 2;
  }
  printf("ready\n");
  (void)fflush(stdout);
  if (fgets(line, sizeof(line), stdin) == NULL) {
    return 3;
  }
  while (message.data < MOST &&
         refused < REFUSED) { /* a terminal that moves what it has takes more a little later */
    if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
      ++message.data;
      refused = 0;
    } else {
      rcl_reset_error();
      port_sleep_ms(1);
      ++refused;
    }
  }
  printf("%d\n", (int)message.data);
  (void)fflush(stdout);
  start = port_time_ms();
  (void)rclc_support_fini(&support); /* that the agent may not answer is no matter here */
  printf("%u\n", (unsigned)(port_time_ms() - start));
  return 0;
}
