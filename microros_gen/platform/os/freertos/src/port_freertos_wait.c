/* SPDX-License-Identifier: Apache-2.0 */
/* One binary semaphore: it ends one wait, or the next one. Networks and drivers call port_wake when something has arrived. */
#include "microros/port.h"
#include "microros/port_freertos.h"

#include "semphr.h"
#include "task.h"

#include <stdbool.h>
#include <stddef.h>

static SemaphoreHandle_t event; /* NULL until the first wait, which looks for what has arrived before */

#ifdef ESP_PLATFORM
/* If tasks of two cores wait first at once, one of them makes the semaphore, and the other waits for it. */
static void event_make(void)
{
  static portMUX_TYPE guard = portMUX_INITIALIZER_UNLOCKED;
  static StaticSemaphore_t storage;
  static bool is_begun;

  if (port_freertos_is_first(&guard, &is_begun)) {
    event = xSemaphoreCreateBinaryStatic(&storage); /* with storage, it cannot fail */
  }
  while (event == NULL) {
    vTaskDelay(1);
  }
}
#else
static void event_make(void)
{
  static StaticSemaphore_t storage;

  vTaskSuspendAll();
  if (event == NULL) {
    event = xSemaphoreCreateBinaryStatic(&storage); /* with storage, it cannot fail */
  }
  (void)xTaskResumeAll();
}
#endif

/* What arrives on any handle wakes. */
void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  if (event == NULL) {
    event_make();
    return;
  }
  (void)xSemaphoreTake(event, port_freertos_ticks(timeout_ms)); /* false: the time has passed */
}

void port_wake(void)
{
  BaseType_t is_switched = pdFALSE;

  if (event == NULL) {
    return;
  }
  if (PORT_FREERTOS_IS_INTERRUPT()) {
    (void)xSemaphoreGiveFromISR(event, &is_switched); /* fails if it is given already */
    portYIELD_FROM_ISR(is_switched);
  } else {
    (void)xSemaphoreGive(event);
  }
}
