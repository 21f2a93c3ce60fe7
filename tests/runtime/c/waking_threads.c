/* SPDX-License-Identifier: Apache-2.0 */
/* Three tasks that wait for a guard condition each, all of which are triggered before one of them wakes. */
#define _POSIX_C_SOURCE 200809L
#include "port_one_wake.h"
#include "unit.h"

#include <microros/rcl_waiting.h>
#include <rcl/rcl.h>
#include <rcl/wait.h>
#include <rclc/rclc.h>

#include <pthread.h>
#include <semaphore.h>
#include <unistd.h>

enum { TASKS = 3, ROUNDS = 30, LONGEST_S = 60 };

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_guard_condition_t conditions[TASKS];
static sem_t woken;

static void * wait(void * condition)
{
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();

  CHECK(rcl_wait_set_init(&wait_set, 0, 1, 0, 0, 0, 0, &support.context, allocator) == RCL_RET_OK);
  for (int i = 0; i < ROUNDS; ++i) {
    CHECK(rcl_wait_set_clear(&wait_set) == RCL_RET_OK);
    CHECK(rcl_wait_set_add_guard_condition(&wait_set, condition, NULL) == RCL_RET_OK);
    CHECK(rcl_wait(&wait_set, -1) == RCL_RET_OK && wait_set.guard_conditions[0] == condition);
    CHECK(sem_post(&woken) == 0);
  }
  CHECK(rcl_wait_set_fini(&wait_set) == RCL_RET_OK);
  return NULL;
}

static void trigger_all(void)
{
  one_wake_hold(TASKS);
  for (int i = 0; i < TASKS; ++i) {
    CHECK(rcl_trigger_guard_condition(&conditions[i]) == RCL_RET_OK);
  }
  one_wake_release();
  for (int i = 0; i < TASKS; ++i) {
    CHECK(sem_wait(&woken) == 0);
  }
}

/* Of two tasks that have looked and not begun to wait, the first takes the wake-up of the port. */
static void miss_nothing_before_the_wait(void)
{
  rcl_waiting_t one = rcl_waiting_begin(-1);
  rcl_waiting_t other = rcl_waiting_begin(-1);

  CHECK(rcl_trigger_guard_condition(&conditions[0]) == RCL_RET_OK);
  rcl_waiting_rest(&one, INT64_MAX);
  rcl_waiting_rest(&other, INT64_MAX);
}

int main(void)
{
  pthread_t threads[TASKS];

  (void)alarm(LONGEST_S); /* a task that is not woken waits forever */
  CHECK(sem_init(&woken, 0, 0) == 0);
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  for (int i = 0; i < TASKS; ++i) {
    conditions[i] = rcl_get_zero_initialized_guard_condition();
    CHECK(
      rcl_guard_condition_init(&conditions[i], &support.context, rcl_guard_condition_get_default_options()) ==
      RCL_RET_OK);
    CHECK(pthread_create(&threads[i], NULL, wait, &conditions[i]) == 0);
  }
  for (int i = 0; i < ROUNDS; ++i) {
    trigger_all();
  }
  for (int i = 0; i < TASKS; ++i) {
    CHECK(pthread_join(threads[i], NULL) == 0);
  }
  miss_nothing_before_the_wait();
  return 0;
}
