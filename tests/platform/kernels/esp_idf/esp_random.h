/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of ESP-IDF that the port calls: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_ESP_RANDOM_H
#define STAND_IN_ESP_RANDOM_H

#include <stdint.h>

uint32_t esp_random(void);

#endif /* STAND_IN_ESP_RANDOM_H */
