/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_PICO_STDIO_H
#define STAND_IN_PICO_STDIO_H

#include <stdbool.h>
#include <stdint.h>

bool stdio_init_all(void);
void stdio_flush(void);
int putchar_raw(int c);
int getchar_timeout_us(uint32_t timeout_us);

#endif /* STAND_IN_PICO_STDIO_H */
