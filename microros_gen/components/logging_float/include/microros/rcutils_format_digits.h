/* SPDX-License-Identifier: Apache-2.0 */
/* The decimal digits of a binary floating-point number, all of them exact. Internal. */
#ifndef MICROROS_RCUTILS_FORMAT_DIGITS_H
#define MICROROS_RCUTILS_FORMAT_DIGITS_H

#include <stdbool.h>
#include <stdint.h>

/* Enough for the largest and for the smallest double: 2^1024 and 2^-1074. */
enum { MICROROS_DIGITS_GROUPS = 78, MICROROS_DIGITS_LIMBS = 68 };

/* A number of which the digits from `place` (a power of ten) on are left. */
typedef struct microros_digits_t {
  uint16_t whole[MICROROS_DIGITS_GROUPS]; /* four digits each, the last ones at its end */
  uint16_t part[MICROROS_DIGITS_LIMBS];   /* after the point, in binary; the first bits first */
  uint32_t used;                          /* limbs of `part` up to the last one that is not 0 */
  int32_t place;
} microros_digits_t;

/* Starts before the first digit of a finite double without its sign, whose bits are given. */
void microros_digits_begin(microros_digits_t * digits, uint64_t bits);

/* Returns the next digit. */
uint32_t microros_digits_next(microros_digits_t * digits);

/* Returns whether only zeros are left. */
bool microros_digits_end(const microros_digits_t * digits);

#endif /* MICROROS_RCUTILS_FORMAT_DIGITS_H */
