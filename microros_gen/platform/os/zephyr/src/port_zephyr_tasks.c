/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_tasks.h"
#include "microros/port_zephyr.h"
#include "microros_config.h"

#include <stddef.h>

#if CONFIG_NUM_PREEMPT_PRIORITIES < MICROROS_TASKS
#error "prj.conf: set CONFIG_NUM_PREEMPT_PRIORITIES to at least MICROROS_TASKS of microros_config.h"
#endif
#if !defined(CONFIG_INIT_STACKS)
#error "prj.conf: set CONFIG_INIT_STACKS=y"
#endif
#if !defined(CONFIG_THREAD_STACK_INFO)
#error "prj.conf: set CONFIG_THREAD_STACK_INFO=y"
#endif

typedef struct kernel_task_t {
  struct k_thread thread;
  struct k_sem event;
  const port_task_t * setting; /* NULL: never made */
} kernel_task_t;

static const uint64_t ns_per_us = 1000;

static kernel_task_t kernel_tasks[MICROROS_TASKS];

/* The tasks have the lowest of the preemptive priorities; a smaller number is a higher one. */
static int priority_of(uint8_t priority)
{
  return (PORT_ZEPHYR_LOWEST_PRIORITY) + 1 - (int)priority;
}

static void task_begin(void * place, void * task, void * unused)
{
  const kernel_task_t * kernel_task = (const kernel_task_t *)place;

  (void)unused;
  kernel_task->setting->entry((uint8_t)(uintptr_t)task);
}

/* The stack is one of K_KERNEL_STACK_DEFINE. Callbacks may use floating-point numbers. */
bool port_task_create(uint8_t task, const port_task_t * setting)
{
  kernel_task_t * place = &kernel_tasks[task];
  k_tid_t thread;

  (void)k_sem_init(&place->event, 0, 1); /* fails for a limit of 0 */
  place->setting = setting;
  thread = k_thread_create(
    &place->thread, (k_thread_stack_t *)setting->stack, setting->stack_size, task_begin, place,
    (void *)(uintptr_t)task, NULL, priority_of(setting->priority), K_FP_REGS,
    K_NO_WAIT);
  (void)k_thread_name_set(thread, setting->name); /* without CONFIG_THREAD_NAME it has none */
  return true;
}

void port_task_join(uint8_t task)
{
  (void)k_thread_join(&kernel_tasks[task].thread, K_FOREVER);
}

uint8_t port_task_self(void)
{
  const struct k_thread * self = k_current_get();

  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    if (&kernel_tasks[task].thread == self) {
      return task;
    }
  }
  return (uint8_t)PORT_TASK_NONE;
}

bool port_task_has_priorities(void)
{
  return true;
}

bool port_task_set_priority(uint8_t task, uint8_t priority)
{
  k_thread_priority_set(&kernel_tasks[task].thread, priority_of(priority));
  return true;
}

void port_task_set(uint8_t task)
{
  k_sem_give(&kernel_tasks[task].event);
}

void port_task_wait(uint8_t task, uint32_t timeout_ms)
{
  (void)k_sem_take(&kernel_tasks[task].event, K_MSEC(timeout_ms)); /* an error: the time has passed */
}

uint32_t port_task_time_us(void)
{
  return (uint32_t)(((uint64_t)port_time_steady_ns() / ns_per_us) & UINT32_MAX);
}

uint32_t port_task_first_release_us(void)
{
  return port_task_time_us();
}

/* The kernel counts from a tick that was read before the time, so nothing that passes meanwhile makes the sleep longer.
 * Where cycles count, the first sleep can end within the last tick before the time. */
void port_task_sleep_until(uint32_t time_us)
{
  int64_t now = k_uptime_ticks();
  uint32_t left_us = time_us - port_task_time_us();

  while (left_us != 0u && left_us <= (uint32_t)INT32_MAX) {
    (void)k_sleep(K_TIMEOUT_ABS_TICKS(now + (int64_t)k_us_to_ticks_ceil64(left_us)));
    now = k_uptime_ticks();
    left_us = time_us - port_task_time_us();
  }
}

uint32_t port_task_stack_peak(uint8_t task)
{
  const kernel_task_t * place = &kernel_tasks[task];
  size_t unused = 0;

  if (place->setting == NULL || k_thread_stack_space_get(&place->thread, &unused) != 0) {
    return 0;
  }
  return unused < place->setting->stack_size ? place->setting->stack_size - (uint32_t)unused : 0u;
}
