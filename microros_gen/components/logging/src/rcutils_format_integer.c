/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcutils_format.h"

enum { DIGITS_MOST = 22, NANOSECOND_DIGITS = 9 }; /* of 64 bits in octal; of a fraction of a second */

uint32_t microros_format_divide(uint64_t * value, uint32_t divisor)
{
  const uint32_t half_bits = 16;
  uint64_t quotient = 0;
  uint32_t remainder = 0;

  for (uint32_t shift = 4u * half_bits; shift != 0u; shift -= half_bits) { /* at most 4 rounds */
    const uint32_t part = remainder << half_bits | (uint32_t)(*value >> (shift - half_bits) & UINT16_MAX);

    quotient = quotient << half_bits | part / divisor;
    remainder = part % divisor;
  }
  *value = quotient;
  return remainder;
}

/* Writes the digits of `value` to the end of `digits`; returns how many, none for 0. */
static int32_t integer_digits(char * digits, uint64_t value, char kind)
{
  const char * const figures = kind == 'X' ? "0123456789ABCDEF" : "0123456789abcdef";
  uint32_t base = 10;
  uint64_t left = value;
  int32_t count = 0;

  if (kind == 'o') {
    base = 8;
  }
  if (kind == 'x' || kind == 'X') {
    base = 16;
  }
  /* at most DIGITS_MOST rounds, MICROROS_LOG_LONGEST + 1 + DIGITS_MOST in each microros_format_arguments */
  while (left != 0u) {
    ++count;
    digits[DIGITS_MOST - count] = figures[microros_format_divide(&left, base)];
  }
  return count;
}

/* Returns the sign, or what is before the digits of `#`. */
static const char * integer_prefix(const microros_conversion_t * how, uint64_t value, bool negative)
{
  if (how->kind == 'd' || how->kind == 'i') {
    if (negative) {
      return "-";
    }
    if (how->plus) {
      return "+";
    }
    return how->space ? " " : "";
  }
  if (!how->alternative || value == 0u) {
    return "";
  }
  if (how->kind == 'x') {
    return "0x";
  }
  return how->kind == 'X' ? "0X" : "";
}

static int32_t integer_length(const char * prefix)
{
  int32_t length = 0;

  while (prefix[length] != '\0') { /* at most 2 rounds */
    ++length;
  }
  return length;
}

/* Returns how many zeros stand before `count` digits, without those that fill the field. */
static int32_t integer_zeros(const microros_conversion_t * how, int32_t count)
{
  int32_t least = how->precision < 0 ? 1 : how->precision;

  if (how->kind == 'o' && how->alternative && least <= count) {
    least = count + 1;
  }
  return least > count ? least - count : 0;
}

void microros_format_integer(
  microros_format_t * out, const microros_conversion_t * how, uint64_t value, bool negative)
{
  char digits[DIGITS_MOST];
  const char * const prefix = integer_prefix(how, value, negative);
  const int32_t count = integer_digits(digits, value, how->kind);
  int32_t zeros = integer_zeros(how, count);
  int32_t fill = how->width - integer_length(prefix) - zeros - count;

  if (how->zero && !how->minus && how->precision < 0 && fill > 0) {
    zeros += fill;
    fill = 0;
  }
  microros_format_repeat(out, ' ', how->minus ? 0 : fill);
  microros_format_string(out, prefix);
  microros_format_repeat(out, '0', zeros);
  /* at most DIGITS_MOST rounds, MICROROS_LOG_LONGEST + 1 of all loops in each microros_format_arguments
     or microros_format_begin or microros_format_integer */
  for (int32_t i = DIGITS_MOST - count; i < DIGITS_MOST && !out->truncated; ++i) {
    microros_format_put(out, digits[i]);
  }
  microros_format_repeat(out, ' ', how->minus ? fill : 0);
}

uint64_t microros_format_seconds(int64_t time, uint32_t * nanoseconds)
{
  uint64_t left = time < 0 ? 0u : (uint64_t)time;
  uint32_t step = 1;

  *nanoseconds = 0;
  for (int digit = 0; digit < NANOSECOND_DIGITS; ++digit) {
    *nanoseconds += microros_format_divide(&left, 10u) * step;
    step *= 10u;
  }
  return left;
}
