/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_FREERTOS_SEMPHR_H
#define STAND_IN_FREERTOS_SEMPHR_H

#include "FreeRTOS.h"

typedef struct kernel_semaphore_t * SemaphoreHandle_t;

typedef struct StaticSemaphore_t {
  void * reserved[20];
} StaticSemaphore_t;

SemaphoreHandle_t xSemaphoreCreateBinaryStatic(StaticSemaphore_t * storage);
SemaphoreHandle_t xSemaphoreCreateRecursiveMutexStatic(StaticSemaphore_t * storage);
BaseType_t xSemaphoreTake(SemaphoreHandle_t semaphore, TickType_t ticks);
BaseType_t xSemaphoreGive(SemaphoreHandle_t semaphore);
BaseType_t xSemaphoreGiveFromISR(SemaphoreHandle_t semaphore, BaseType_t * is_switched);
BaseType_t xSemaphoreTakeRecursive(SemaphoreHandle_t semaphore, TickType_t ticks);
BaseType_t xSemaphoreGiveRecursive(SemaphoreHandle_t semaphore);

#endif /* STAND_IN_FREERTOS_SEMPHR_H */
