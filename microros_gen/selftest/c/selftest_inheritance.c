/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Priority inversion: a low task holds the lock, the high one waits for it, and a middle one needs no lock and spins. The
 * low task gets on only if it inherits the priority of the one that waits.
 */
#include "microros/port.h"
#include "microros_config.h"
#include "selftest_checks.h"
#include "selftest_pool.h"
#include "selftest_report.h"

enum { HOLD_US = 10000, SPIN_US = 150000, BOUND_US = 75000, LONG_MS = 1000 };

/* Each task writes its own; read when all were joined. */
static struct {
  uint32_t low_end_us;
  uint32_t middle_begin_us;
  uint32_t waited_us;
} seen;

static void spin(uint32_t duration_us)
{
  const uint32_t start_us = port_task_time_us();

  while (port_task_time_us() - start_us < duration_us) {
    /* needs the processor */
  }
}

static void low(uint8_t task)
{
  (void)task;
  port_lock();
  port_task_set(SELFTEST_HIGH);
  port_task_set(SELFTEST_MIDDLE);
  spin((uint32_t)HOLD_US);
  seen.low_end_us = port_task_time_us();
  port_unlock();
}

static void middle(uint8_t task)
{
  port_task_wait(task, (uint32_t)LONG_MS);
  seen.middle_begin_us = port_task_time_us();
  spin((uint32_t)SPIN_US);
}

static void high(uint8_t task)
{
  uint32_t start_us;

  port_task_wait(task, (uint32_t)LONG_MS);
  start_us = port_task_time_us();
  port_lock();
  seen.waited_us = port_task_time_us() - start_us;
  port_unlock();
}

/* Both can fall into one tick where the system counts whole ones: that is no overlap. */
static bool middle_began_before_low_ended(void)
{
  const uint32_t both_us = seen.low_end_us - seen.middle_begin_us;

  return both_us != 0u && both_us < (uint32_t)INT32_MAX;
}

/* On one processor the middle task runs before the end of the low one only if it has delayed it. */
static void judge(void)
{
  const bool is_delayed = seen.waited_us > (uint32_t)BOUND_US;

  if (!port_task_has_priorities()) {
    selftest_skip(
      "lock_inheritance", "the system does not keep to priorities (SCHED_FIFO needs CAP_SYS_NICE)");
  } else if (!is_delayed && middle_began_before_low_ended()) {
    selftest_skip(
      "lock_inheritance", "tasks run on several processors (on Linux, start it with taskset -c 0)");
  } else {
    selftest_at_most(
      "lock_inheritance", (int64_t)seen.waited_us, (int64_t)BOUND_US, "us until the high task has the lock");
  }
}

void selftest_inheritance(void)
{
  static const port_task_entry_t entries[SELFTEST_POOL] = {low, middle, high};
  uint8_t task = SELFTEST_POOL;

  if ((uint32_t)MICROROS_TASKS < (uint32_t)SELFTEST_POOL) {
    selftest_skip("lock_inheritance", "it takes three tasks, and the application has fewer");
    return;
  }
  while (task > 0u && selftest_start((uint8_t)(task - 1u), entries[task - 1u])) {
    --task;
  }
  for (uint8_t made = task; made < (uint8_t)SELFTEST_POOL; ++made) {
    port_task_join(made);
  }
  if (task == 0u) {
    judge();
  }
}
