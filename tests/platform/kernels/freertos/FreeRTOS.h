/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of FreeRTOS that the port calls: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_FREERTOS_H
#define STAND_IN_FREERTOS_H

#include <stdint.h>

#ifndef KERNEL_TICK_RATE_HZ
#define KERNEL_TICK_RATE_HZ 1000
#endif
#define configTICK_RATE_HZ ((TickType_t)KERNEL_TICK_RATE_HZ) /* as in most configurations: no constant of the preprocessor */
#define configSUPPORT_STATIC_ALLOCATION 1
#define configUSE_MUTEXES 1
#define configUSE_RECURSIVE_MUTEXES 1
#define configUSE_TIMERS 1
#define configMAX_PRIORITIES (5) /* as in most configurations: a constant of the preprocessor */
#define INCLUDE_vTaskDelay 1
#define INCLUDE_vTaskDelete 1
#define INCLUDE_vTaskPrioritySet 1
#define INCLUDE_vTaskSuspend 1
#define INCLUDE_xTaskDelayUntil 1
#define INCLUDE_xTaskGetCurrentTaskHandle 1
#define INCLUDE_uxTaskGetStackHighWaterMark 1
#if defined(KERNEL_CORES) && !defined(ESP_PLATFORM)
#define configNUMBER_OF_CORES KERNEL_CORES
#endif
#if defined(KERNEL_CORES) || defined(ESP_PLATFORM)
#define INCLUDE_eTaskGetState 1
#endif

typedef long BaseType_t;
typedef unsigned long UBaseType_t;
typedef uint32_t TickType_t;
typedef uint32_t StackType_t;
typedef uint32_t configSTACK_DEPTH_TYPE;

#define portMAX_DELAY ((TickType_t)0xffffffffu)
#define portYIELD_FROM_ISR(is_switched) port_yield_from_isr(is_switched)
#define pdFALSE ((BaseType_t)0)
#define pdTRUE ((BaseType_t)1)
#define pdPASS pdTRUE

#ifdef ESP_PLATFORM /* as the FreeRTOS of ESP-IDF has it */
#define portNUM_PROCESSORS 2
#define portMUX_INITIALIZER_UNLOCKED {0, 0}
#define portENTER_CRITICAL(mux) kernel_mux_enter(mux)
#define portEXIT_CRITICAL(mux) kernel_mux_exit(mux)

typedef struct portMUX_TYPE {
  uint32_t owner;
  uint32_t count;
} portMUX_TYPE;

void kernel_mux_enter(portMUX_TYPE * mux);
void kernel_mux_exit(portMUX_TYPE * mux);
BaseType_t xPortInIsrContext(void);
#endif

void port_yield_from_isr(BaseType_t is_switched);
BaseType_t xPortIsInsideInterrupt(void);
uint32_t kernel_time_us(void);

#endif /* STAND_IN_FREERTOS_H */
