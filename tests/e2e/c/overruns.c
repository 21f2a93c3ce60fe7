/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Two tasks, of which one ends some runs after its deadline and after its next releases, until the standard input ends. Then
 * it prints the counters and the size of the stack of each task: overruns, missed, failed, stack_size.
 */
#include <microros/tasks.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { LATE_NS = 50000000, LATE_RUNS = 3, FIRST_LATE = 20 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t fast;
static rclc_executor_t slow;
static rcl_guard_condition_t second;
static rcl_guard_condition_t first;

static void check(rcl_ret_t result, const char * what)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

static void on_nothing(void)
{
}

static void on_release(uint8_t task)
{
  static uint32_t runs;
  const struct timespec late = {.tv_nsec = LATE_NS};

  (void)task;
  ++runs;
  if (runs >= FIRST_LATE && runs < FIRST_LATE + LATE_RUNS) {
    (void)nanosleep(&late, NULL);
  }
}

static void show(uint8_t task)
{
  rclc_task_counters_t counters;

  check(rclc_task_get_counters(task, &counters), "counters");
  (void)printf(
    "%" PRIu32 " %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", counters.overruns, counters.missed, counters.failed,
    rclc_task_stack_size(task));
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  check(rclc_node_init_default(&node, "device", "", &support), "node");
  second = rcl_get_zero_initialized_guard_condition();
  first = rcl_get_zero_initialized_guard_condition();
  check(
    rcl_guard_condition_init(&second, &support.context, rcl_guard_condition_get_default_options()), "guard");
  check(
    rcl_guard_condition_init(&first, &support.context, rcl_guard_condition_get_default_options()), "guard");
  check(rclc_executor_init(&fast, &support.context, 1, &allocator), "executor");
  check(rclc_executor_init(&slow, &support.context, 1, &allocator), "executor");
  check(rclc_executor_add_guard_condition(&fast, &first, on_nothing), "add");
  check(rclc_executor_add_guard_condition(&slow, &second, on_nothing), "add");
  check(rclc_task_set_executor(RCLC_TASK_CONTROL, &fast, on_release), "task");
  check(rclc_task_set_executor(RCLC_TASK_WORKER, &slow, NULL), "task");
  check(rclc_tasks_start(), "start");
  while (getchar() != EOF) {
  }
  check(rclc_tasks_stop(), "stop");
  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    show(task);
  }
  return 0;
}
