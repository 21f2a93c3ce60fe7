/* SPDX-License-Identifier: Apache-2.0 */
/* What examples/boards/pico calls of the Pico SDK's pico/time.h. */
#ifndef STAND_IN_PICO_TIME_H
#define STAND_IN_PICO_TIME_H

#include <stdint.h>

typedef uint64_t absolute_time_t;

absolute_time_t get_absolute_time(void);
uint32_t to_ms_since_boot(absolute_time_t t);
void sleep_ms(uint32_t ms);

#endif /* STAND_IN_PICO_TIME_H */
