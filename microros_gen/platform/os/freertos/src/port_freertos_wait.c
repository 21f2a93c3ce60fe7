/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Each task that waits has a separate event, a binary semaphore, from its first wait on. port_wake sets all of them:
 * a task that is busy meanwhile finds its event set at its next wait. Networks and drivers call port_wake when something
 * has arrived.
 */
#include "microros/port.h"
#include "microros/port_freertos.h"

#include "semphr.h"
#include "task.h"

#include <stddef.h>

typedef struct waiter_t {
  TaskHandle_t task;
  StaticSemaphore_t storage;
  SemaphoreHandle_t event; /* set last: not NULL from then on */
} waiter_t;

static waiter_t waiters[PORT_FREERTOS_WAITERS];

/* Returns the event of the calling task, which its first call makes; NULL: more tasks wait than there are places. */
static SemaphoreHandle_t event_of_task(void)
{
  const TaskHandle_t task = xTaskGetCurrentTaskHandle();
  SemaphoreHandle_t event = NULL;

  vTaskSuspendAll();
  for (size_t i = 0; i < (size_t)PORT_FREERTOS_WAITERS && event == NULL; ++i) {
    waiter_t * place = &waiters[i];

    if (place->event == NULL) {
      place->task = task;
      place->event = xSemaphoreCreateBinaryStatic(&place->storage); /* with storage, it cannot fail */
    }
    if (place->task == task) {
      event = place->event;
    }
  }
  (void)xTaskResumeAll();
  return event;
}

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  const SemaphoreHandle_t event = event_of_task();
  const TickType_t ticks = port_freertos_ticks(timeout_ms);

  (void)handle; /* what arrives on any of them wakes */
  if (event != NULL) {
    (void)xSemaphoreTake(event, ticks); /* may return early, or without an event */
  } else if (ticks != 0u) {
    vTaskDelay(1);
  }
}

static void wake_from_interrupt(void)
{
  BaseType_t is_switched = pdFALSE;

  for (size_t i = 0; i < (size_t)PORT_FREERTOS_WAITERS && waiters[i].event != NULL; ++i) {
    (void)xSemaphoreGiveFromISR(waiters[i].event, &is_switched); /* fails if it is set already */
  }
  portYIELD_FROM_ISR(is_switched);
}

void port_wake(void)
{
  if (PORT_FREERTOS_IS_INTERRUPT()) {
    wake_from_interrupt();
    return;
  }
  for (size_t i = 0; i < (size_t)PORT_FREERTOS_WAITERS && waiters[i].event != NULL; ++i) {
    (void)xSemaphoreGive(waiters[i].event);
  }
}
