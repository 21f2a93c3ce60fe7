/* SPDX-License-Identifier: Apache-2.0 */
/* What examples/boards/esp32c3 uses of FreeRTOS: ticks of 10 ms, ESP-IDF's default. */
#ifndef STAND_IN_FREERTOS_H
#define STAND_IN_FREERTOS_H

#include <stdint.h>

typedef uint32_t TickType_t;
#define pdMS_TO_TICKS(ms) ((TickType_t)((ms) / 10u))

#endif /* STAND_IN_FREERTOS_H */
