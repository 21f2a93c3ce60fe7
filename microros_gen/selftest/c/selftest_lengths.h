/* SPDX-License-Identifier: Apache-2.0 */
/* Messages of several lengths, for what sends to itself. */
#ifndef SELFTEST_LENGTHS_H
#define SELFTEST_LENGTHS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Fills a message; each length has other bytes. */
void selftest_fill(uint8_t * bytes, size_t size);

/* Returns whether it is what selftest_fill writes. */
bool selftest_is_filled(const uint8_t * bytes, size_t size);

/* Returns the next length to try, 0 after the last: all up to 16, then twice as many, and the largest with those around it. */
size_t selftest_next_length(size_t length, size_t largest);

#endif /* SELFTEST_LENGTHS_H */
