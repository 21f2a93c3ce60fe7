/* SPDX-License-Identifier: Apache-2.0 */
/* Formatting into a text of fixed size, without the C library's printf. */
#ifndef MICROROS_RCUTILS_FORMAT_H
#define MICROROS_RCUTILS_FORMAT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* `text` has room for `size` characters; what does not fit is left out. */
typedef struct microros_format_t {
  char * text;
  size_t size;
  size_t used;
  bool truncated;
} microros_format_t;

/* Flags, width, precision (-1: none) and length of a conversion. */
typedef struct microros_conversion_t {
  bool minus;
  bool zero;
  bool plus;
  bool space;
  bool alternative;
  int32_t width;
  int32_t precision;
  char length; /* h, H for hh, l, q for ll, z, j, t, L; 0 without one */
  char kind;
} microros_conversion_t;

void microros_format_put(microros_format_t * out, char character);

/* Puts `count` times the same character; a negative count is none. */
void microros_format_repeat(microros_format_t * out, char character, int32_t count);

void microros_format_string(microros_format_t * out, const char * string);

/* As vsnprintf, from the position of `out` on. Takes from `args` what the format names. */
void microros_format_arguments(microros_format_t * out, const char * format, va_list * args);

/* Marks a text that was cut off with `...` at its end, and counts it. */
void microros_format_end(microros_format_t * out);

/* Counts a message that a writer did not take. */
void microros_format_dropped(void);

/* Puts an integer: of the types of d, i, u, x, X, o. */
void microros_format_integer(
  microros_format_t * out, const microros_conversion_t * how, uint64_t value, bool negative);

/* Puts what is before the text of a line: `[INFO] [1700000000.123456789] [arm]: `. */
void microros_format_begin(microros_format_t * out, int severity, const char * name, int64_t time);

/* Returns the seconds of a time of day, 0 for one before 1970, and the nanoseconds after them. */
uint64_t microros_format_seconds(int64_t time, uint32_t * nanoseconds);

/* Divides in steps that a processor without division of 64 bits has; returns the remainder. `divisor` is at most 2^16. */
uint32_t microros_format_divide(uint64_t * value, uint32_t divisor);

#endif /* MICROROS_RCUTILS_FORMAT_H */
