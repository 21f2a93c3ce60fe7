/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_FREERTOS_TASK_H
#define STAND_IN_FREERTOS_TASK_H

#include "freertos/FreeRTOS.h"

void vTaskDelay(TickType_t ticks);

#endif /* STAND_IN_FREERTOS_TASK_H */
