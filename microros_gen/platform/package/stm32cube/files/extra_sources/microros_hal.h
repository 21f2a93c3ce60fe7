/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the files of this folder take from a project of STM32CubeMX: the HAL by its main.h, and FreeRTOS if the
 * project has it. MICROROS_USE_FREERTOS says so where the compiler cannot find out.
 */
#ifndef MICROROS_HAL_H
#define MICROROS_HAL_H

#include "main.h"

#include <stdbool.h>
#include <stdint.h>

#if !defined(MICROROS_USE_FREERTOS) && defined(__has_include)
#if __has_include("FreeRTOS.h")
#define MICROROS_USE_FREERTOS 1
#endif
#endif

#ifndef MICROROS_USE_FREERTOS
#define MICROROS_USE_FREERTOS 0
#endif

/* Waits for an interrupt, at most about a millisecond; with FreeRTOS, other tasks run for a tick. */
void cubemx_rest(void);

/* Waits as cubemx_rest. Returns false without waiting once `timeout_ms` have passed since `start_ms` (HAL_GetTick), or
 * after microros_wake. */
bool cubemx_rest_until(uint32_t start_ms, int timeout_ms);

#endif /* MICROROS_HAL_H */
