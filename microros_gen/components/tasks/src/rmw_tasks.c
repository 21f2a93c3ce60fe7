/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_tasks.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/port_tasks.h"
#include "microros/rmw_client.h"
#include "microros/rmw_turn.h"
#include "microros/wake.h"
#include "microros/xrce_client.h"
#include "microros/xrce_turn.h"
#include "microros_config.h"

typedef struct waiting_task_t {
  uint32_t released_us;
  uint32_t until_ms; /* end of the wait */
  bool waits;
  bool is_released;
  bool is_over; /* it is to end */
} waiting_task_t;

static waiting_task_t waiting_tasks[MICROROS_TASKS]; /* the lock guards them */

/* The last task is that of the session, and runs it as every other task of the application does. */
static bool runs_an_executor(uint8_t task)
{
  return task < (uint8_t)MICROROS_TASKS - 1u;
}

bool rmw_turn_pumps(void)
{
  bool pumps;

  microros_lock();
  pumps = !runs_an_executor(port_task_self()) && xrce_turn_is_mine();
  microros_unlock();
  return pumps;
}

bool rmw_turn_is_over(void)
{
  const uint8_t task = port_task_self();
  bool is_over = false;

  if (runs_an_executor(task)) {
    microros_lock();
    is_over = waiting_tasks[task].is_over;
    microros_unlock();
  }
  return is_over;
}

/* Everything that was counted before the task last looked was seen, and left nothing to run: a release before must not
 * count for a later run. From then on the task of the session looks at the executor of this one before it waits for news
 * itself. */
bool rmw_turn_waits(uint32_t timeout_ms, uint32_t * news)
{
  const uint8_t task = port_task_self();
  bool waits;

  if (!runs_an_executor(task)) {
    return false;
  }
  microros_lock();
  waits = *news == microros_news() && !waiting_tasks[task].is_over;
  waiting_tasks[task].waits = waits;
  waiting_tasks[task].is_released = false;
  waiting_tasks[task].until_ms = port_time_ms() + timeout_ms;
  *news = microros_news();
  microros_unlock();
  if (waits) {
    port_task_wait(task, timeout_ms);
    microros_lock();
    waiting_tasks[task].waits = false;
    *news = microros_news();
    microros_unlock();
  }
  return true;
}

void rmw_tasks_begin(uint8_t task)
{
  waiting_tasks[task].is_over = false;
  waiting_tasks[task].is_released = false;
}

void rmw_tasks_end(uint8_t task)
{
  waiting_tasks[task].is_over = true;
  waiting_tasks[task].waits = false;
}

void rmw_tasks_take_line(void)
{
  microros_lock();
  xrce_turn_take();
  microros_unlock();
}

/* What the transport does not take now is dropped, and other tasks send from then on. */
void rmw_tasks_leave_line(void)
{
  xrce_client_t * client = rmw_client_instance();

  while (xrce_turn_write(client)) {
    /* until all is written, or refused */
  }
  microros_lock();
  client->session.statistics.dropped += xrce_turn_close();
  xrce_turn_leave();
  microros_unlock();
}

bool rmw_tasks_write(void)
{
  return xrce_turn_write(rmw_client_instance());
}

bool rmw_tasks_waits(uint8_t task)
{
  return waiting_tasks[task].waits;
}

uint32_t rmw_tasks_until_ms(uint8_t task)
{
  return waiting_tasks[task].until_ms;
}

void rmw_tasks_wake(uint8_t task)
{
  waiting_tasks[task].waits = false;
  port_task_set(task);
}

void rmw_tasks_release(uint8_t task, uint32_t now_us)
{
  waiting_tasks[task].is_released = true;
  waiting_tasks[task].released_us = now_us;
  rmw_tasks_wake(task);
}

uint32_t rmw_tasks_released(uint8_t task, uint32_t now_us)
{
  const uint32_t released_us = waiting_tasks[task].is_released ? waiting_tasks[task].released_us : now_us;

  waiting_tasks[task].is_released = false;
  return released_us;
}
