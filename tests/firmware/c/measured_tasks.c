/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The jobs of tasks, one after the other in main: what a task calls to rest ends its job, and returns for the next one
 * until there were enough. A mark stands before and after each job; with MEASURED_HOLDS=TASK instead before and
 * after that task holds the library's lock, and with MEASURED_STACKS each task has its own stack, whose high-water mark is found. The agent
 * is in the firmware. The application file is that of test_tasks.py; with MEASURED_TEXTS that of test_task_texts.py.
 */
#include "measured.h"
#include "tasks_in_turn.h"

#include <microros/port_tasks.h>
#include <microros/rclc_tasks.h>
#include <microros/rmw_tasks.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#ifdef MEASURED_TEXTS
#include "measured_texts.h"
#else
#include "measured_number.h"
#endif

enum { JOBS = 4, ROUNDS = 3, EXECUTORS = 2 };

static uint8_t self = PORT_TASK_NONE;
static uint32_t rests;
static uint32_t depth;
static bool is_measured;
static bool is_in_job;
static uint32_t heard_count;
#ifdef RECURSES
static volatile uint32_t recursed;
#endif

static void check(bool holds)
{
  if (!holds) {
    finish();
  }
}

static void job_mark(bool begins)
{
  if (begins != is_in_job) {
#ifndef MEASURED_HOLDS
    mark();
#endif
    is_in_job = begins;
  }
}

void port_lock(void)
{
#ifdef MEASURED_HOLDS
  if (depth == 0u && is_measured) {
    mark();
  }
#endif
  ++depth;
}

void port_unlock(void)
{
  --depth;
#ifdef MEASURED_HOLDS
  if (depth == 0u && is_measured) {
    mark();
  }
#endif
}

/* Between two jobs of the task. Those that it is to have are over: stopping needs a caller that is no task. */
static void rest(void)
{
  const uint8_t task = self;

  if (task == (uint8_t)PORT_TASK_NONE) {
    return;
  }
  job_mark(false);
  ++rests;
  if (rests > (uint32_t)JOBS) {
    is_measured = false;
    self = PORT_TASK_NONE;
    check(rclc_tasks_stop() == RCL_RET_OK);
    self = task;
    return;
  }
  job_mark(true);
}

bool port_task_create(uint8_t task, const port_task_t * setting)
{
  (void)task;
  (void)setting;
  return true;
}

uint8_t port_task_self(void)
{
  return self;
}

bool port_task_has_priorities(void)
{
  return true;
}

bool port_task_set_priority(uint8_t task, uint8_t priority)
{
  (void)task;
  (void)priority;
  return true;
}

void port_task_wait(uint8_t task, uint32_t timeout_ms)
{
  (void)task;
  (void)timeout_ms;
  rest();
}

void port_task_sleep_until(uint32_t time_us)
{
  (void)time_us;
  rest();
}

uint32_t port_task_stack_peak(uint8_t task)
{
  (void)task;
  return 0;
}

void port_wait(int handle, uint32_t timeout_ms)
{
  (void)handle;
  (void)timeout_ms;
  rest();
}

void port_wake(void)
{
}

#ifdef RECURSES
static uint32_t recurse(uint32_t depth_left)
{
  volatile uint32_t here = depth_left;

  return depth_left == 0u ? here : recurse(depth_left - 1u) + here;
}
#endif

static void on_release(uint8_t task)
{
#ifdef RECURSES
  recursed = recurse(task);
#endif
#ifdef LARGE_SIZE
  volatile uint8_t large[LARGE_SIZE];

  large[0] = task;
  large[LARGE_SIZE - 1] = large[0];
#endif
  (void)task;
  check(messages_publish());
}

static void on_message(const void * message)
{
  (void)message;
  ++heard_count;
}

#ifdef MEASURED_STACKS
enum { FILL = 0xa5 };

void call_on(port_task_entry_t entry, uint8_t task, void * top);

/* Calls the entry with the process stack, on which the processor also puts the registers of what an interrupt stops. */
__asm(".pushsection .text.call_on, \"ax\"\n"
      ".global call_on\n"
      ".type call_on, %function\n"
      ".thumb_func\n"
      "call_on:\n"
      "push {r4, lr}\n"
      "msr psp, r2\n"
      "mov r4, r0\n"
      "mov r0, r1\n"
      "movs r2, #2\n"
      "msr control, r2\n"
      "isb\n"
      "blx r4\n"
      "movs r2, #0\n"
      "msr control, r2\n"
      "isb\n"
      "pop {r4, pc}\n"
      ".size call_on, . - call_on\n"
      ".popsection\n");

uint32_t stack_report[MICROROS_TASKS + 1]; /* high-water marks; then whether they are complete */

static void enter(uint8_t task)
{
  const port_task_t * setting = &rclc_task_settings[task];
  volatile uint8_t * stack = setting->stack;
  uint32_t unused = 0;

  for (uint32_t i = 0; i < setting->stack_size; ++i) {
    stack[i] = (uint8_t)FILL;
  }
  call_on(setting->entry, task, (uint8_t *)setting->stack + setting->stack_size);
  while (unused < setting->stack_size && stack[unused] == (uint8_t)FILL) {
    ++unused;
  }
  if (stack_report[task] < setting->stack_size - unused) {
    stack_report[task] = setting->stack_size - unused;
  }
}
#else
static void enter(uint8_t task)
{
  rclc_task_settings[task].entry(task);
}
#endif

/* Ends where the task has had its jobs. */
static void run(uint8_t task)
{
  check(rclc_tasks_start() == RCL_RET_OK);
  rests = 0;
  self = task;
#ifdef MEASURED_HOLDS
  is_measured = task == (uint8_t)MEASURED_HOLDS;
#endif
  rmw_tasks_take_line(); /* as while the task of the session runs, which it does not here while another one does */
  enter(task);
  is_measured = false;
  rmw_tasks_leave_line();
  self = PORT_TASK_NONE;
}

int main(void)
{
  static rclc_support_t support;
  static rcl_node_t node;
  static rcl_subscription_t subscription;
  static rclc_executor_t executors[EXECUTORS];
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  check(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  check(messages_init(&node, &subscription));
  for (uint8_t i = 0; i < (uint8_t)EXECUTORS; ++i) {
    check(rclc_executor_init(&executors[i], &support.context, 1, &allocator) == RCL_RET_OK);
  }
  check(
    rclc_executor_add_subscription(&executors[1], &subscription, &heard, on_message, ON_NEW_DATA) ==
    RCL_RET_OK);
  check(rclc_task_set_executor(RCLC_TASK_CONTROL, &executors[0], on_release) == RCL_RET_OK);
  check(rclc_task_set_executor(RCLC_TASK_WORKER, &executors[1], NULL) == RCL_RET_OK);
  for (uint32_t i = 0; i < (uint32_t)ROUNDS; ++i) {
    run(RCLC_TASK_CONTROL);
    run(RCLC_TASK_WORKER);
    run(RCLC_TASK_SESSION);
  }
  check(published == (uint32_t)ROUNDS * (uint32_t)JOBS && heard_count == published / (uint32_t)HEARD_EACH);
#ifdef MEASURED_STACKS
  stack_report[MICROROS_TASKS] = 1;
  for (;;) {
  }
#else
  mark(); /* the end of what is measured */
  finish();
#endif
}
