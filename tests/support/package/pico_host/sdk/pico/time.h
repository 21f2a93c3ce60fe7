/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_PICO_TIME_H
#define STAND_IN_PICO_TIME_H

#include <stdint.h>

typedef uint64_t absolute_time_t;

absolute_time_t get_absolute_time(void);
uint32_t to_ms_since_boot(absolute_time_t time);
uint64_t to_us_since_boot(absolute_time_t time);
void sleep_ms(uint32_t ms);

#endif /* STAND_IN_PICO_TIME_H */
