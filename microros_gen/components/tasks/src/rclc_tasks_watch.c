/* SPDX-License-Identifier: Apache-2.0 */
/* The watchdog is fed while no task is late: by each task that ends a run or a wait. */
#include "microros/rclc_tasks_watch.h"

#include "microros/lock.h"
#include "microros/port_watchdog.h"
#include "microros/rclc_tasks.h"
#include "microros/rclc_tasks_state.h"
#include "microros_config.h"

enum { WATCH_REST_US = RCLC_TASKS_WAIT_MOST_MS * 1000 };

typedef struct watched_task_t {
  uint32_t since_us; /* may be to come */
  uint32_t limit_us; /* time from then until it says something again */
  bool is_late;      /* kept until then: a count of microseconds wraps while a task is away for good */
  bool is_off;       /* it does not run */
} watched_task_t;

static watched_task_t watched_tasks[MICROROS_TASKS]; /* the lock guards them */

static void watch_set(uint8_t task, uint32_t since_us, uint32_t rest_us)
{
  watched_task_t * watched = &watched_tasks[task];

  watched->since_us = since_us;
  watched->limit_us = rclc_task_plans[task].deadline_us + rest_us + (uint32_t)MICROROS_WATCHDOG_MARGIN_US;
  watched->is_late = false;
}

/* The longest wait of a task without a period, and its pause after a run. */
static uint32_t watch_rest_us(uint8_t task)
{
  return (uint32_t)WATCH_REST_US + rclc_task_plans[task].interval_us;
}

static void watch_look(watched_task_t * watched, uint32_t now_us)
{
  const uint32_t passed_us = now_us - watched->since_us;

  if ((passed_us <= (uint32_t)INT32_MAX) && (passed_us > watched->limit_us)) {
    watched->is_late = true;
  }
}

static void watch_feed(uint32_t now_us)
{
  bool is_late = false;

  for (uint8_t task = 0; task < (uint8_t)MICROROS_TASKS; ++task) {
    watch_look(&watched_tasks[task], now_us);
    is_late = is_late || (watched_tasks[task].is_late && !watched_tasks[task].is_off);
  }
  if (!is_late) {
    port_watchdog_feed();
  }
}

void rclc_tasks_watch_begin(uint8_t task)
{
  if (rclc_task_plans[task].period_us != 0u) {
    watch_set(task, rclc_task_states[task].next_us, 0);
  } else {
    watch_set(task, port_task_time_us(), watch_rest_us(task));
  }
  watched_tasks[task].is_off = false;
}

void rclc_tasks_watch_end(uint8_t task)
{
  watched_tasks[task].is_off = true;
}

void rclc_tasks_watch_release(uint8_t task, uint32_t released_us)
{
  watch_look(&watched_tasks[task], port_task_time_us());
  if (!watched_tasks[task].is_late) { /* otherwise it is for the task itself to say that it goes on */
    watch_set(task, released_us, 0);
  }
}

void rclc_tasks_watch_period(uint8_t task, uint32_t next_us)
{
  microros_lock();
  watch_feed(port_task_time_us());
  watch_set(task, next_us, 0);
  microros_unlock();
}

void rclc_tasks_watch_run(uint8_t task)
{
  uint32_t now_us;

  microros_lock();
  now_us = port_task_time_us();
  watch_feed(now_us);
  watch_set(task, now_us, 0);
  microros_unlock();
}

void rclc_tasks_watch_rest(uint8_t task)
{
  uint32_t now_us;

  microros_lock();
  now_us = port_task_time_us();
  watch_feed(now_us);
  watch_set(task, now_us, watch_rest_us(task));
  microros_unlock();
}
