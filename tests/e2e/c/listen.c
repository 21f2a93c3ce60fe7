/* SPDX-License-Identifier: Apache-2.0 */
/* Two subscriptions without an executor: prints what it takes, until it has the last number. */
#include <microros/rmw_subscription.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>

#include <stdio.h>
#include <stdlib.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t numbers;
static rcl_subscription_t words;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

/* Arguments: the last number to wait for. */
int main(int argc, char ** argv)
{
  const long last = argc > 1 ? strtol(argv[1], NULL, 10) : 0;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  static std_msgs__msg__Int32 number;
  static std_msgs__msg__String word; /* without buffers: bound to the storage of its declaration */
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rcl_ret_t result;

  qos.depth = 1000; /* what waits for room here waits at the agent */
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "ear", "", &support), "node");
  check(
    rclc_subscription_init(
      &numbers, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "numbers", &qos),
    "numbers");
  check(
    rclc_subscription_init_best_effort(
      &words, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "words"),
    "words");
  rmw_subscription_bind(rcl_subscription_get_rmw_handle(&words), &word);
  (void)printf("ready\n");
  (void)fflush(stdout);
  number.data = -1;
  while (number.data != last) {
    result = rcl_take(&numbers, &number, NULL, NULL);
    if (result == RCL_RET_OK) {
      (void)printf("number %ld\n", (long)number.data);
    } else if (result != RCL_RET_SUBSCRIPTION_TAKE_FAILED) {
      check(result, "take");
    }
    result = rcl_take(&words, &word, NULL, NULL);
    if (result == RCL_RET_OK) {
      (void)printf("word %s\n", word.data.data);
    } else if (result != RCL_RET_SUBSCRIPTION_TAKE_FAILED) {
      (void)printf("refused %s\n", rcl_get_error_string().str);
      rcl_reset_error();
    }
    (void)fflush(stdout);
    rclc_sleep_ms(1);
  }
  check(rcl_subscription_fini(&words, &node), "fini");
  check(rcl_subscription_fini(&numbers, &node), "fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
