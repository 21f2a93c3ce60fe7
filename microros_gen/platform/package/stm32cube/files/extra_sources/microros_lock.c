/* SPDX-License-Identifier: Apache-2.0 */
/* The lock of `+multithread`: a recursive mutex of FreeRTOS, whose holder inherits the priority of the waiting task. */
#include "microros_hal.h"

#include "microros/port.h"

#if !MICROROS_USE_FREERTOS
#error "+multithread needs FreeRTOS: enable it in STM32CubeMX, or remove +multithread from microros.yaml"
#endif

#include "FreeRTOS.h"
#include "semphr.h"
#include "task.h"

#if configSUPPORT_STATIC_ALLOCATION != 1 || configUSE_RECURSIVE_MUTEXES != 1
#error "enable configSUPPORT_STATIC_ALLOCATION and configUSE_RECURSIVE_MUTEXES in STM32CubeMX"
#endif

static SemaphoreHandle_t mutex;

static void mutex_create(void)
{
  static StaticSemaphore_t storage;

  taskENTER_CRITICAL();
  if (mutex == NULL) {
    mutex = xSemaphoreCreateRecursiveMutexStatic(&storage);
  }
  taskEXIT_CRITICAL();
}

void port_lock(void)
{
  if (mutex == NULL) {
    mutex_create();
  }
  (void)xSemaphoreTakeRecursive(mutex, portMAX_DELAY); /* without an end it cannot fail */
}

void port_unlock(void)
{
  (void)xSemaphoreGiveRecursive(mutex);
}
