/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One time awake of a device that sleeps: publishes some numbers, prints what it takes, and sleeps. The process ends
 * there; what it leaves is a file. Arguments: the file, the first number, how many, how many to take, and how long the
 * session runs before the node is opened, in milliseconds (none: not at all).
 */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <stdio.h>
#include <stdlib.h>

static rmw_uros_retained_t retained;
static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription;
static rcl_publisher_t publisher;

static void check(bool good, const char * what)
{
  if (!good) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void wake(const char * name)
{
  FILE * file = fopen(name, "rb");
  bool woken = false;

  if (file != NULL) {
    woken = fread(&retained, sizeof(retained), 1, file) == 1u && rmw_uros_wake(&retained);
    (void)fclose(file);
  }
  (void)printf("%s\n", woken ? "woken" : "cold");
}

static void go_to_sleep(const char * name)
{
  FILE * file = fopen(name, "wb");

  check(
    rmw_uros_sleep(rcl_context_get_rmw_context(&support.context), &retained, 5000) == RMW_RET_OK, "sleep");
  check(file != NULL && fwrite(&retained, sizeof(retained), 1, file) == 1u && fclose(file) == 0, "file");
}

static void open_all(uint32_t pause_ms)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  qos.depth = 1000;
  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK, "init");
  if (pause_ms != 0u) {
    rclc_sleep_ms(pause_ms);
    check(rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)) == RMW_RET_OK, "spin");
  }
  check(rclc_node_init_default(&node, "sleeper", "", &support) == RCL_RET_OK, "node");
  check(rclc_publisher_init(&publisher, &node, type, "sleep_out", &qos) == RCL_RET_OK, "publisher");
  check(rclc_subscription_init(&subscription, &node, type, "sleep_in", &qos) == RCL_RET_OK, "subscription");
}

int main(int argc, char ** argv)
{
  const int32_t first = argc > 4 ? (int32_t)strtol(argv[2], NULL, 10) : 0;
  const int32_t count = argc > 4 ? (int32_t)strtol(argv[3], NULL, 10) : 0;
  long left = argc > 4 ? strtol(argv[4], NULL, 10) : 0;
  std_msgs__msg__Int32 number;

  check(argc > 4, "arguments");
  wake(argv[1]);
  open_all(argc > 5 ? (uint32_t)strtoul(argv[5], NULL, 10) : 0u);
  (void)printf("ready\n");
  (void)fflush(stdout);
  for (number.data = first; number.data < first + count; ++number.data) {
    check(rcl_publish(&publisher, &number, NULL) == RCL_RET_OK, "publish");
  }
  while (left > 0) {
    if (rcl_take(&subscription, &number, NULL, NULL) == RCL_RET_OK) {
      (void)printf("%ld\n", (long)number.data);
      --left;
    }
    rclc_sleep_ms(1);
  }
  go_to_sleep(argv[1]);
  return 0; /* what is not in the file is gone */
}
