/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_FREERTOS_TASK_H
#define STAND_IN_FREERTOS_TASK_H

#include "FreeRTOS.h"

typedef struct TimeOut_t {
  BaseType_t xOverflowCount;
  TickType_t xTimeOnEntering;
} TimeOut_t;

typedef struct kernel_task_control_t * TaskHandle_t;
typedef void (*TaskFunction_t)(void * argument);

typedef struct StaticTask_t {
  void * reserved[30];
} StaticTask_t;

#define tskIDLE_PRIORITY ((UBaseType_t)0u)

TaskHandle_t xTaskCreateStatic(
  TaskFunction_t function, const char * name, configSTACK_DEPTH_TYPE depth, void * argument,
  UBaseType_t priority, StackType_t * stack, StaticTask_t * storage);
BaseType_t xTaskDelayUntil(TickType_t * previous, TickType_t increment);
TaskHandle_t xTaskGetCurrentTaskHandle(void);
#ifdef INCLUDE_eTaskGetState
typedef enum { eRunning, eReady, eBlocked, eSuspended, eDeleted, eInvalid } eTaskState;

eTaskState eTaskGetState(TaskHandle_t task);
#endif
UBaseType_t uxTaskGetStackHighWaterMark(TaskHandle_t task);
void vTaskDelete(TaskHandle_t task);
void vTaskPrioritySet(TaskHandle_t task, UBaseType_t priority);
void vTaskSuspend(TaskHandle_t task);

#ifndef ESP_PLATFORM /* which has a lock as an argument */
#define taskENTER_CRITICAL() kernel_critical(1)
#define taskEXIT_CRITICAL() kernel_critical(0)
#endif

void kernel_critical(int is_entered);
void vTaskDelay(TickType_t ticks);

#define taskSCHEDULER_RUNNING ((BaseType_t)2)
BaseType_t xTaskGetSchedulerState(void);
void vTaskSuspendAll(void);
BaseType_t xTaskResumeAll(void);
void vTaskSetTimeOutState(TimeOut_t * now);
TickType_t xTaskGetTickCount(void);

#endif /* STAND_IN_FREERTOS_TASK_H */
