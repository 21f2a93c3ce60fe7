/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_freertos.h"

#include "semphr.h"
#include "task.h"

#include <stdbool.h>
#include <stddef.h>

#if !defined(configUSE_MUTEXES) || configUSE_MUTEXES != 1
#error "FreeRTOSConfig.h: set configUSE_MUTEXES to 1"
#endif
#if !defined(configUSE_RECURSIVE_MUTEXES) || configUSE_RECURSIVE_MUTEXES != 1
#error "FreeRTOSConfig.h: set configUSE_RECURSIVE_MUTEXES to 1"
#endif

static SemaphoreHandle_t lock; /* the kernel's mutexes inherit priority */

#ifdef ESP_PLATFORM
/* If tasks of two cores call the library first at once, one of them makes the lock, and the other waits for it. */
static void lock_make(void)
{
  static portMUX_TYPE guard = portMUX_INITIALIZER_UNLOCKED;
  static StaticSemaphore_t storage;
  static bool is_begun;

  if (port_freertos_is_first(&guard, &is_begun)) {
    lock = xSemaphoreCreateRecursiveMutexStatic(&storage); /* with storage, it cannot fail */
  }
  while (lock == NULL) {
    vTaskDelay(1);
  }
}
#else
/* The first call of the library makes it, while no other task runs. */
static void lock_make(void)
{
  static StaticSemaphore_t storage;

  vTaskSuspendAll();
  if (lock == NULL) {
    lock = xSemaphoreCreateRecursiveMutexStatic(&storage); /* with storage, it cannot fail */
  }
  (void)xTaskResumeAll();
}
#endif

void port_lock(void)
{
  if (lock == NULL) {
    lock_make();
  }
  (void)xSemaphoreTakeRecursive(lock, portMAX_DELAY); /* waits without a limit */
}

void port_unlock(void)
{
  (void)xSemaphoreGiveRecursive(lock);
}
