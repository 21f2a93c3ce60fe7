/* SPDX-License-Identifier: Apache-2.0 */
/* A node whose levels others set: prints what the logger `loud` logs, and ends with the level FATAL of the logger `end`. */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rcutils/logging_macros.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TURNS_AFTER = 50 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void print(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  (void)location;
  (void)severity;
  (void)timestamp;
  (void)args;
  if (strcmp(name, "loud") == 0) {
    (void)printf("%s: %s\n", name, format);
    (void)fflush(stdout);
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  rcutils_logging_set_output_handler(print);
  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "arm", &support), "node");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  (void)printf("ready\n");
  (void)fflush(stdout);
  while (rcutils_logging_get_logger_level("end") != RCUTILS_LOG_SEVERITY_FATAL) {
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)), "spin");
    RCUTILS_LOG_WARN_EXPRESSION_NAMED(
      rcutils_logging_get_logger_level("loud") == RCUTILS_LOG_SEVERITY_DEBUG, "loud", "heard");
  }
  for (int i = 0; i < TURNS_AFTER; ++i) { /* the last reply has to be acknowledged */
    check(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10)), "spin");
  }
  check(rclc_executor_fini(&executor), "executor fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
