/* SPDX-License-Identifier: Apache-2.0 */
/* A reliable subscription whose samples share the bytes of their queue: prints first letter and size of each, until "end". */
#include <microros/rmw_subscription.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/string.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t words;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void report(void)
{
  rmw_uros_subscription_statistics_t counted;

  if (rmw_uros_get_subscription_statistics(rcl_subscription_get_rmw_handle(&words), &counted) == RMW_RET_OK) {
    (void)printf("dropped %u refused %u\n", (unsigned)counted.dropped, (unsigned)counted.refused);
  }
}

/* Arguments: milliseconds between two samples. */
int main(int argc, char ** argv)
{
  const int64_t pause_ms = argc > 1 ? strtol(argv[1], NULL, 10) : 0;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  static std_msgs__msg__String word; /* without buffers: bound to the storage of its declaration */
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  bool ended = false;

  qos.depth = 1000; /* what waits for room here waits at the agent */
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "ear", "", &support), "node");
  check(
    rclc_subscription_init(&words, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "words", &qos),
    "words");
  rmw_subscription_bind(rcl_subscription_get_rmw_handle(&words), &word);
  while (!ended) {
    const rcl_ret_t result = rcl_take(&words, &word, NULL, NULL);

    if (result == RCL_RET_OK) {
      const size_t same = strspn(word.data.data, (const char[]){word.data.data[0], '\0'});

      (void)printf(
        "%c %lu %s\n", word.data.data[0], (unsigned long)word.data.size,
        same == word.data.size ? "whole" : "-");
      ended = strcmp(word.data.data, "end") == 0;
    } else if (result != RCL_RET_SUBSCRIPTION_TAKE_FAILED) {
      check(result, "take");
    }
    rclc_sleep_ms(result == RCL_RET_OK ? pause_ms : 1);
  }
  report();
  check(rcl_subscription_fini(&words, &node), "fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
