/* SPDX-License-Identifier: Apache-2.0 */
/* Logs before the session and in it, with every kind of text; Arguments: how many lines, and turns after them. */
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rcutils/logging_macros.h>
#include <rmw_microros/rmw_microros.h>

#include <stdio.h>
#include <stdlib.h>

enum { TURN_MS = 20, TURNS_AFTER = 50 };

static rclc_support_t support;
static rcl_node_t node;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

int main(int argc, char ** argv)
{
  const int count = argc > 1 ? atoi(argv[1]) : 0;
  const int after = argc > 2 ? atoi(argv[2]) : TURNS_AFTER;
  rcl_allocator_t allocator = rcl_get_default_allocator();

  RCUTILS_LOG_INFO_NAMED("arm.device", "before the session");
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "arm", &support), "node");
  (void)printf("ready\n");
  (void)fflush(stdout);
  RCUTILS_LOG_DEBUG("%s is below the level", "debug");
  RCUTILS_LOG_ERROR_NAMED(rcl_node_get_logger_name(&node), "%d µm of \"%s\"", 42, "glass");
  for (int i = 0; i < count; ++i) {
    RCUTILS_LOG_WARN("line %d", i);
    check(rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)), "spin");
    rclc_sleep_ms(TURN_MS);
  }
  for (int i = 0; i < after; ++i) {
    check(rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)), "spin");
    rclc_sleep_ms(TURN_MS);
  }
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
