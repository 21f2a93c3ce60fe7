/* SPDX-License-Identifier: Apache-2.0 */
/*
 * FreeRTOS 10.4 or newer. What the application can set, and what its FreeRTOSConfig.h must contain: a missing
 * setting stops the compiler. All objects are static. The kernel's vectors, start-up code and linker script belong
 * to the application.
 */
#ifndef MICROROS_PORT_FREERTOS_H
#define MICROROS_PORT_FREERTOS_H

#include "FreeRTOS.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if !defined(configSUPPORT_STATIC_ALLOCATION) || configSUPPORT_STATIC_ALLOCATION != 1
#error "FreeRTOSConfig.h: set configSUPPORT_STATIC_ALLOCATION to 1"
#endif
#if !defined(INCLUDE_vTaskDelay) || INCLUDE_vTaskDelay != 1
#error "FreeRTOSConfig.h: set INCLUDE_vTaskDelay to 1"
#endif

/* Whether the caller of port_wake is an interrupt. The kernel's ports for Cortex-M3 and later have this function, and
 * ESP-IDF has its own; for other processors, define the macro in FreeRTOSConfig.h. */
#if !defined(PORT_FREERTOS_IS_INTERRUPT) && defined(ESP_PLATFORM)
#define PORT_FREERTOS_IS_INTERRUPT() (xPortInIsrContext() != pdFALSE)
#elif !defined(PORT_FREERTOS_IS_INTERRUPT)
#define PORT_FREERTOS_IS_INTERRUPT() (xPortIsInsideInterrupt() == pdTRUE)
#endif

#ifdef ESP_PLATFORM
/* Returns true once: for one of the tasks that call it with the same objects, of any core. vTaskSuspendAll of ESP-IDF stops
 * the tasks of the caller's core only. Internal. */
static inline bool port_freertos_is_first(portMUX_TYPE * guard, bool * is_begun)
{
  bool is_first;

  portENTER_CRITICAL(guard);
  is_first = !*is_begun;
  *is_begun = true;
  portEXIT_CRITICAL(guard);
  return is_first;
}
#endif

/* FreeRTOSConfig.h may define PORT_FREERTOS_TIME_US as the name of a function that returns microseconds as a uint32_t, from
 * any task: tasks of the application file then measure their runs with it. It counts between the ticks, so it must run at
 * their rate. Without it they count whole ticks. */

/* Returns the ticks since the scheduler started; does not wrap. */
uint64_t port_freertos_now(void);

/* Returns the ticks that last at least `duration_ms`, not counting the current one, and at most portMAX_DELAY - 1. */
TickType_t port_freertos_ticks(uint32_t duration_ms);

/* Sets the time of day that port_time_epoch_ns returns, in nanoseconds since 1970-01-01 00:00 UTC. From any task. */
void port_freertos_epoch_set(int64_t now_ns);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_FREERTOS_H */
