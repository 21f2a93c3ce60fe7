/* SPDX-License-Identifier: Apache-2.0 */
/* Two threads, as tasks of two cores of an ESP32, call the library first at once: the second one while the first one makes
 * the semaphore. Each semaphore is made once, and the second task waits for it. */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"
#include "microros/port_freertos.h"
#include "semphr.h"
#include "task.h"

#include <pthread.h>
#include <stddef.h>
#include <unistd.h>

static pthread_mutex_t mux = PTHREAD_MUTEX_INITIALIZER;
static pthread_mutex_t guard = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t has_waited = PTHREAD_COND_INITIALIZER;
static void (*ask)(void);
static pthread_t other;
static int made;
static int waited;

static void * second_core(void * nothing)
{
  ask();
  return nothing;
}

/* Returns only when the other task waits for the semaphore. */
static SemaphoreHandle_t make(void * storage)
{
  ++made;
  if (made > 2 || pthread_create(&other, NULL, second_core, NULL) != 0) {
    _exit(3);
  }
  (void)pthread_mutex_lock(&guard);
  while (waited == 0) {
    (void)pthread_cond_wait(&has_waited, &guard);
  }
  (void)pthread_mutex_unlock(&guard);
  return (SemaphoreHandle_t)storage;
}

SemaphoreHandle_t xSemaphoreCreateRecursiveMutexStatic(StaticSemaphore_t * storage)
{
  return make(storage);
}

SemaphoreHandle_t xSemaphoreCreateBinaryStatic(StaticSemaphore_t * storage)
{
  return make(storage);
}

void vTaskDelay(TickType_t ticks)
{
  (void)ticks;
  (void)pthread_mutex_lock(&guard);
  ++waited;
  (void)pthread_cond_signal(&has_waited);
  (void)pthread_mutex_unlock(&guard);
}

void kernel_mux_enter(portMUX_TYPE * lock)
{
  (void)lock;
  (void)pthread_mutex_lock(&mux);
}

void kernel_mux_exit(portMUX_TYPE * lock)
{
  (void)lock;
  (void)pthread_mutex_unlock(&mux);
}

BaseType_t xSemaphoreTakeRecursive(SemaphoreHandle_t semaphore, TickType_t ticks)
{
  (void)ticks;
  return semaphore != NULL ? pdTRUE : pdFALSE;
}

BaseType_t xSemaphoreGiveRecursive(SemaphoreHandle_t semaphore)
{
  return semaphore != NULL ? pdTRUE : pdFALSE;
}

BaseType_t xSemaphoreTake(SemaphoreHandle_t semaphore, TickType_t ticks)
{
  (void)ticks;
  return semaphore != NULL ? pdTRUE : pdFALSE;
}

BaseType_t xSemaphoreGive(SemaphoreHandle_t semaphore)
{
  return semaphore != NULL ? pdTRUE : pdFALSE;
}

BaseType_t xSemaphoreGiveFromISR(SemaphoreHandle_t semaphore, BaseType_t * is_switched)
{
  (void)is_switched;
  return semaphore != NULL ? pdTRUE : pdFALSE;
}

void port_yield_from_isr(BaseType_t is_switched)
{
  (void)is_switched;
}

BaseType_t xPortInIsrContext(void)
{
  return pdFALSE;
}

TickType_t port_freertos_ticks(uint32_t duration_ms)
{
  return duration_ms;
}

static void wait_a_moment(void)
{
  port_wait(-1, 1);
}

int main(void)
{
  ask = port_lock;
  port_lock();
  if (pthread_join(other, NULL) != 0 || made != 1) {
    return 1;
  }
  waited = 0;
  ask = wait_a_moment;
  wait_a_moment();
  return pthread_join(other, NULL) == 0 && made == 2 ? 0 : 2;
}
