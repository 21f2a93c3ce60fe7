/* SPDX-License-Identifier: Apache-2.0 */
/* What examples/boards/esp32c3 calls of ESP-IDF's esp_timer.h; posix.c has it. */
#ifndef STAND_IN_ESP_TIMER_H
#define STAND_IN_ESP_TIMER_H

#include <stdint.h>

int64_t esp_timer_get_time(void);

#endif /* STAND_IN_ESP_TIMER_H */
