/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "port_one_wake.h"

#include "microros/port.h"

#include <pthread.h>
#include <stdbool.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
static unsigned waiting;
static bool woken;
static bool held;

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  (void)timeout_ms;
  (void)pthread_mutex_lock(&mutex);
  ++waiting;
  (void)pthread_cond_broadcast(&condition);
  while (!woken || held) {
    (void)pthread_cond_wait(&condition, &mutex);
  }
  woken = false;
  --waiting;
  (void)pthread_mutex_unlock(&mutex);
}

void port_wake(void)
{
  (void)pthread_mutex_lock(&mutex);
  woken = true;
  (void)pthread_cond_broadcast(&condition);
  (void)pthread_mutex_unlock(&mutex);
}

void one_wake_hold(unsigned tasks)
{
  (void)pthread_mutex_lock(&mutex);
  held = true;
  while (waiting < tasks) {
    if (woken) { /* it is left from the round before: somebody looks once more */
      held = false;
      (void)pthread_cond_broadcast(&condition);
    }
    (void)pthread_cond_wait(&condition, &mutex);
    held = true;
  }
  (void)pthread_mutex_unlock(&mutex);
}

void one_wake_release(void)
{
  (void)pthread_mutex_lock(&mutex);
  held = false;
  (void)pthread_cond_broadcast(&condition);
  (void)pthread_mutex_unlock(&mutex);
}
