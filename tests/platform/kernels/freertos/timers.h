/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_FREERTOS_TIMERS_H
#define STAND_IN_FREERTOS_TIMERS_H

#include "FreeRTOS.h"

typedef struct kernel_timer_object_t * TimerHandle_t;
typedef void (*TimerCallbackFunction_t)(TimerHandle_t timer);

typedef struct StaticTimer_t {
  void * reserved[11];
} StaticTimer_t;

TimerHandle_t xTimerCreateStatic(
  const char * name, TickType_t period, BaseType_t is_repeated, void * id, TimerCallbackFunction_t callback,
  StaticTimer_t * storage);
void * pvTimerGetTimerID(TimerHandle_t timer);
BaseType_t xTimerIsTimerActive(TimerHandle_t timer);
BaseType_t xTimerChangePeriod(TimerHandle_t timer, TickType_t period, TickType_t ticks);
BaseType_t xTimerStop(TimerHandle_t timer, TickType_t ticks);

#endif /* STAND_IN_FREERTOS_TIMERS_H */
