/* SPDX-License-Identifier: Apache-2.0 */
/* What examples/boards/pico calls of the Pico SDK's pico/stdio.h; posix.c has it over a terminal. */
#ifndef STAND_IN_PICO_STDIO_H
#define STAND_IN_PICO_STDIO_H

#include <stdbool.h>
#include <stdint.h>

bool stdio_init_all(void);
int putchar_raw(int c);
void stdio_flush(void);
int getchar_timeout_us(uint32_t timeout_us);

#endif /* STAND_IN_PICO_STDIO_H */
