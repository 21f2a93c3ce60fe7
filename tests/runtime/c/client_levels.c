/* SPDX-License-Identifier: Apache-2.0 */
/* A node with logger services in the hands of the test: one call for each line of standard input. */
#include "fake_no_wait.h"
#include "fake_program.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rcutils/logging.h>

#include <stdio.h>
#include <string.h>

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_allocator_t allocator;

static rcl_ret_t start(void)
{
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  return result == RCL_RET_OK ? rclc_executor_init(&executor, &support.context, 1, &allocator) : result;
}

static rcl_ret_t end(void)
{
  rcl_ret_t result = rclc_executor_fini(&executor);

  if (result == RCL_RET_OK) {
    result = rcl_node_fini(&node);
  }
  return result == RCL_RET_OK ? rclc_support_fini(&support) : result;
}

static rcl_ret_t call(const char * line)
{
  const char * space = strchr(line, ' ');

  switch (line[0]) {
    case 'i': /* init */
      return start();
    case 'l': /* level NAME */
      printf("level %d\n", rcutils_logging_get_logger_level(space != NULL ? &space[1] : ""));
      return RCL_RET_OK;
    case 'e': /* end */
      return end();
    default: /* spin */
      return rclc_executor_spin_some(&executor, 0);
  }
}

static void work(char * line)
{
  report_result(call(line));
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  return run_calls(work);
}
