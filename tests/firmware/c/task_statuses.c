/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tasks with a stack each on a Cortex-M4, which reports them on /diagnostics. A task that rests gives the processor to
 * the next one: this file is their operating system. The task `control` is late once, and uses more of its stack then.
 */
#include "tasks_in_turn.h"

#include <microros/port.h>
#include <microros/port_tasks.h>
#include <microros/rclc_tasks.h>
#include <microros/tasks.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

enum { EXECUTORS = 2, FILL = 0xa5, SAVED = 9, LATE_RUN = 20, LATE_MS = 100, USED = 1200 };

typedef struct task_t {
  uint32_t * top; /* where its registers are saved */
  bool is_made;
} task_t;

/* Failed calls; runs of `control`; a sum, so that its stack is used. */
volatile uint32_t task_report[3];

static task_t tasks[MICROROS_TASKS];
static uint32_t * main_top;
static uint8_t self = PORT_TASK_NONE;

void switch_stack(uint32_t ** from, uint32_t * to);

/* Saves registers on the present stack, its top in *from, and continues with the stack `to`. */
__asm(".pushsection .text.switch_stack, \"ax\"\n"
      ".global switch_stack\n"
      ".type switch_stack, %function\n"
      ".thumb_func\n"
      "switch_stack:\n"
      "push {r4-r11, lr}\n"
      "mov r2, sp\n"
      "str r2, [r0]\n"
      "mov sp, r1\n"
      "pop {r4-r11, pc}\n"
      ".size switch_stack, . - switch_stack\n"
      ".popsection\n");

static void rest(void)
{
  if (self != (uint8_t)PORT_TASK_NONE) {
    switch_stack(&tasks[self].top, main_top);
  }
}

/* What a task begins with. */
static void begin(void)
{
  const uint8_t task = self;

  rclc_task_settings[task].entry(task);
  tasks[task].is_made = false;
  for (;;) {
    rest();
  }
}

void port_lock(void)
{
}

void port_unlock(void)
{
}

bool port_task_create(uint8_t task, const port_task_t * setting)
{
  uint8_t * stack = setting->stack;
  uint32_t * top = (uint32_t *)(void *)&stack[setting->stack_size];

  for (uint32_t i = 0; i < setting->stack_size; ++i) {
    stack[i] = (uint8_t)FILL;
  }
  top[-1] = (uint32_t)(uintptr_t)begin;
  tasks[task].top = top - SAVED;
  tasks[task].is_made = true;
  return true;
}

uint8_t port_task_self(void)
{
  return self;
}

bool port_task_has_priorities(void)
{
  return false;
}

bool port_task_set_priority(uint8_t task, uint8_t priority)
{
  (void)task;
  (void)priority;
  return false;
}

void port_task_wait(uint8_t task, uint32_t timeout_ms)
{
  (void)task;
  (void)timeout_ms;
  rest();
}

void port_task_sleep_until(uint32_t time_us)
{
  while (time_us - port_task_time_us() - 1u < (uint32_t)INT32_MAX) {
    rest();
  }
}

uint32_t port_task_stack_peak(uint8_t task)
{
  const uint8_t * stack = rclc_task_settings[task].stack;
  uint32_t unused = 0;

  while (unused < rclc_task_settings[task].stack_size && stack[unused] == (uint8_t)FILL) {
    ++unused;
  }
  return rclc_task_settings[task].stack_size - unused;
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

static void use_stack(void)
{
  volatile uint8_t bytes[USED];
  const uint32_t start_ms = port_time_ms();

  for (uint32_t i = 0; i < (uint32_t)USED; ++i) {
    bytes[i] = (uint8_t)i;
  }
  task_report[2] = bytes[USED - 1];
  while (port_time_ms() - start_ms < (uint32_t)LATE_MS) {
  }
}

static void on_release(uint8_t task)
{
  (void)task;
  task_report[1] = task_report[1] + 1u;
  if (task_report[1] == (uint32_t)LATE_RUN) {
    use_stack();
  }
}

static void on_nothing(void)
{
}

static void check(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    task_report[0] = task_report[0] + 1u;
  }
}

int main(void)
{
  static rclc_support_t support;
  static rcl_node_t node;
  static rclc_executor_t executors[EXECUTORS];
  static rcl_guard_condition_t guards[EXECUTORS];
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator));
  check(rclc_node_init_default(&node, "device", "arm", &support));
  for (uint8_t i = 0; i < (uint8_t)EXECUTORS; ++i) {
    check(rclc_executor_init(&executors[i], &support.context, 1, &allocator));
    guards[i] = rcl_get_zero_initialized_guard_condition();
    check(rcl_guard_condition_init(&guards[i], &support.context, rcl_guard_condition_get_default_options()));
    check(rclc_executor_add_guard_condition(&executors[i], &guards[i], on_nothing));
  }
  check(rclc_task_set_executor(RCLC_TASK_CONTROL, &executors[0], on_release));
  check(rclc_task_set_executor(RCLC_TASK_WORKER, &executors[1], NULL));
  check(rclc_tasks_start());
  for (;;) {
    for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
      if (tasks[task].is_made) {
        self = task;
        switch_stack(&main_top, tasks[task].top);
        self = PORT_TASK_NONE;
      }
    }
  }
}
