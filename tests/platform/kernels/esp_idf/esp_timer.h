/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of ESP-IDF that the port calls: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_ESP_TIMER_H
#define STAND_IN_ESP_TIMER_H

#include <stdint.h>

int64_t esp_timer_get_time(void);

#endif /* STAND_IN_ESP_TIMER_H */
