/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_FREERTOS_TASK_H
#define STAND_IN_FREERTOS_TASK_H

#include "FreeRTOS.h"

typedef struct TimeOut_t {
  BaseType_t xOverflowCount;
  TickType_t xTimeOnEntering;
} TimeOut_t;

#define taskENTER_CRITICAL() kernel_critical(1)
#define taskEXIT_CRITICAL() kernel_critical(0)

void kernel_critical(int is_entered);
void vTaskDelay(TickType_t ticks);
void vTaskSuspendAll(void);
BaseType_t xTaskResumeAll(void);
void vTaskSetTimeOutState(TimeOut_t * now);
TickType_t xTaskGetTickCount(void);

#endif /* STAND_IN_FREERTOS_TASK_H */
