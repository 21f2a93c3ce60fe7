/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Threads with stacks of the library. They have priorities of SCHED_FIFO where the process may use it (a limit of
 * RLIMIT_RTPRIO, or the right CAP_SYS_NICE), else those of the process.
 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_posix_task.h"
#include "microros/port_tasks.h"

#include "microros_config.h"

#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <stddef.h>
#include <time.h>

enum { NS_PER_S = 1000000000, NS_PER_MS = 1000000, NS_PER_US = 1000 };

typedef struct posix_task_t {
  const port_task_t * setting;
  pthread_t thread;
  pthread_mutex_t mutex;
  pthread_cond_t condition;
  uint8_t task;
  bool is_set;
  bool has_event;
} posix_task_t;

static posix_task_t posix_tasks[MICROROS_TASKS];
static pthread_key_t self_key; /* the place of the calling thread */
static bool is_plain;          /* a thread has no priority */

static void self_make(void)
{
  (void)pthread_key_create(&self_key, NULL); /* a program has far fewer keys than the system */
}

static void self_once(void)
{
  static pthread_once_t once = PTHREAD_ONCE_INIT;

  (void)pthread_once(&once, self_make);
}

static void * task_begin(void * argument)
{
  posix_task_t * place = argument;

  (void)pthread_setspecific(self_key, place);
  place->setting->entry(place->task);
  return NULL;
}

/* The event is kept when the task is made again. These calls need no memory. */
static bool event_make(posix_task_t * place)
{
  pthread_condattr_t kind;

  if (!place->has_event) {
    (void)pthread_condattr_init(&kind);
    (void)pthread_condattr_setclock(&kind, CLOCK_MONOTONIC);
    place->has_event =
      pthread_mutex_init(&place->mutex, NULL) == 0 && pthread_cond_init(&place->condition, &kind) == 0;
    (void)pthread_condattr_destroy(&kind);
  }
  place->is_set = false;
  return place->has_event;
}

static bool thread_make(posix_task_t * place, const pthread_attr_t * kind)
{
  return pthread_create(&place->thread, kind, task_begin, place) == 0;
}

static struct sched_param priority_of(uint8_t priority)
{
  const struct sched_param found = {.sched_priority = port_posix_task_priority(priority)};

  return found;
}

/* First with the priority, then without: only the attempt tells whether the process may. */
static bool thread_start(posix_task_t * place)
{
  const port_task_t * setting = place->setting;
  const struct sched_param priority = priority_of(setting->priority);
  pthread_attr_t kind;
  bool is_made = false;

  if (pthread_attr_init(&kind) != 0) {
    return false;
  }
  if (pthread_attr_setstack(&kind, setting->stack, setting->stack_size) == 0) {
    is_made = pthread_attr_setinheritsched(&kind, PTHREAD_EXPLICIT_SCHED) == 0 &&
              pthread_attr_setschedpolicy(&kind, SCHED_FIFO) == 0 &&
              pthread_attr_setschedparam(&kind, &priority) == 0 && thread_make(place, &kind);
    if (!is_made) {
      is_plain = true;
      is_made = pthread_attr_setinheritsched(&kind, PTHREAD_INHERIT_SCHED) == 0 && thread_make(place, &kind);
    }
  }
  (void)pthread_attr_destroy(&kind);
  return is_made;
}

bool port_task_create(uint8_t task, const port_task_t * setting)
{
  posix_task_t * place = &posix_tasks[task];

  self_once();
  if (task == 0u) {
    is_plain = false;
  }
  place->setting = setting;
  place->task = task;
  port_posix_task_fill(setting->stack, setting->stack_size);
  return event_make(place) && thread_start(place);
}

void port_task_join(uint8_t task)
{
  (void)pthread_join(posix_tasks[task].thread, NULL);
}

uint8_t port_task_self(void)
{
  const posix_task_t * place;

  self_once();
  place = pthread_getspecific(self_key);
  return place != NULL ? place->task : (uint8_t)PORT_TASK_NONE;
}

bool port_task_has_priorities(void)
{
  return !is_plain;
}

/* Without the right to use priorities the system refuses. */
bool port_task_set_priority(uint8_t task, uint8_t priority)
{
  const struct sched_param wanted = priority_of(priority);

  return pthread_setschedparam(posix_tasks[task].thread, SCHED_FIFO, &wanted) == 0;
}

void port_task_set(uint8_t task)
{
  posix_task_t * place = &posix_tasks[task];

  (void)pthread_mutex_lock(&place->mutex);
  place->is_set = true;
  (void)pthread_cond_signal(&place->condition);
  (void)pthread_mutex_unlock(&place->mutex);
}

/* `ns` is below 2^63 - 10^9. */
static struct timespec time_after(int64_t ns)
{
  struct timespec time = {0, 0};
  int64_t sum_ns;

  (void)clock_gettime(CLOCK_MONOTONIC, &time); /* cannot fail with this clock */
  sum_ns = ns + (int64_t)time.tv_nsec;
  time.tv_sec += (time_t)(sum_ns / NS_PER_S);
  time.tv_nsec = (long)(sum_ns % NS_PER_S);
  return time;
}

void port_task_wait(uint8_t task, uint32_t timeout_ms)
{
  posix_task_t * place = &posix_tasks[task];
  const struct timespec end = time_after((int64_t)timeout_ms * NS_PER_MS);
  int result = 0;

  (void)pthread_mutex_lock(&place->mutex);
  while (!place->is_set && result == 0) {
    result = pthread_cond_timedwait(&place->condition, &place->mutex, &end);
  }
  place->is_set = false;
  (void)pthread_mutex_unlock(&place->mutex);
}

static uint32_t microseconds_of(const struct timespec * time)
{
  const uint64_t us_per_s = (uint64_t)NS_PER_S / NS_PER_US;

  return (uint32_t)(((uint64_t)time->tv_sec * us_per_s + (uint64_t)time->tv_nsec / NS_PER_US) & UINT32_MAX);
}

uint32_t port_task_time_us(void)
{
  const struct timespec now = time_after(0);

  return microseconds_of(&now);
}

uint32_t port_task_first_release_us(void)
{
  return port_task_time_us();
}

/* An absolute time of the system's clock: what passes until it sleeps is no part of the sleep. */
void port_task_sleep_until(uint32_t time_us)
{
  struct timespec end = time_after(0);
  const uint32_t left_us = time_us - microseconds_of(&end);
  const int64_t ns = (int64_t)(end.tv_nsec - end.tv_nsec % NS_PER_US) + (int64_t)left_us * NS_PER_US;

  if (left_us == 0u || left_us > (uint32_t)INT32_MAX) {
    return; /* it has passed */
  }
  end.tv_sec += (time_t)(ns / NS_PER_S);
  end.tv_nsec = (long)(ns % NS_PER_S);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &end, NULL) == EINTR) {
    /* interrupted by a signal of the application: continue to sleep */
  }
}

uint32_t port_task_stack_peak(uint8_t task)
{
  const port_task_t * setting = posix_tasks[task].setting;

  return setting->stack_size - port_posix_task_unused(setting->stack, setting->stack_size);
}
