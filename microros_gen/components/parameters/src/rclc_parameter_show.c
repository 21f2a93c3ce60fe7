/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_show.h"

#include "microros/rclc_parameters.h"

#if MICROROS_PARAMETER_RULES > 0u

static char show_digit(uint32_t digit)
{
  static const char digits[] = "0123456789";

  return digits[digit];
}

uint32_t rclc_parameter_show_integer(char * to, int64_t value)
{
  char digits[PARAMETER_SHOWN_MAX];
  uint64_t rest = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
  uint32_t count = 0;
  uint32_t size = 0;

  do {
    uint64_t digit = 0;

    rest = rclc_parameter_divide(rest, 10u, &digit);
    digits[count] = show_digit((uint32_t)digit);
    ++count;
  } while (rest != 0u);
  if (value < 0) {
    to[size] = '-';
    ++size;
  }
  while (count != 0u) {
    --count;
    to[size] = digits[count];
    ++size;
  }
  return size;
}

#endif

#if MICROROS_PARAMETER_RULES > 1u

enum { SHOW_DIGITS = 6, SHOW_LEAST = -4 };

/* A number as its first digits, without zeros at the end, and the power of ten of the first one. */
typedef struct show_number_t {
  char digits[SHOW_DIGITS];
  int32_t count;
  int32_t exponent;
} show_number_t;

/* Multiplies by a power of ten, which is exact up to 10^22: of what a reason is likely to have, each digit is right. */
static double show_scaled(double value, int32_t power)
{
  const int32_t exact = 22;
  double scaled = value;
  double factor = 1.0;
  int32_t left = power < 0 ? -power : power;

  while (left > exact) {
    scaled = power < 0 ? scaled / 1e22 : scaled * 1e22;
    left -= exact;
  }
  for (int32_t i = 0; i < left; ++i) {
    factor *= 10.0;
  }
  return power < 0 ? scaled / factor : scaled * factor;
}

/* Returns the exponent of ten of a finite number above 0. */
static int32_t show_exponent_of(double value)
{
  int32_t exponent = 0;

  while (show_scaled(value, -exponent) >= 10.0) {
    ++exponent;
  }
  while (show_scaled(value, -exponent) < 1.0) {
    --exponent;
  }
  return exponent;
}

/* For a finite number above 0; half a digit is rounded to an even one. */
static void show_split(double value, show_number_t * number)
{
  const int32_t exponent = show_exponent_of(value);
  const double scaled = show_scaled(value, SHOW_DIGITS - 1 - exponent);
  uint32_t rounded = (uint32_t)scaled;
  const double rest = scaled - (double)rounded;

  number->count = SHOW_DIGITS;
  number->exponent = exponent;
  if (rest > 0.5 || (rest >= 0.5 && rounded % 2u == 1u)) {
    ++rounded;
  }
  if (rounded >= 1000000u) {
    rounded /= 10u;
    ++number->exponent;
  }
  for (int32_t i = SHOW_DIGITS - 1; i >= 0; --i) {
    number->digits[i] = show_digit(rounded % 10u);
    rounded /= 10u;
  }
  while (number->count > 1 && number->digits[number->count - 1] == '0') {
    --number->count;
  }
}

static uint32_t show_text(char * to, const char * text)
{
  uint32_t size = 0;

  for (; text[size] != '\0'; ++size) {
    to[size] = text[size];
  }
  return size;
}

/* Writes digits with a point before the digit `point`, and zeros after the last one. */
static uint32_t show_digits(char * to, const show_number_t * number, int32_t from, int32_t point)
{
  const int32_t end = number->count > point ? number->count : point;
  uint32_t size = 0;

  for (int32_t i = from; i < end; ++i) {
    if (i == point) {
      to[size] = '.';
      ++size;
    }
    to[size] = i < 0 || i >= number->count ? '0' : number->digits[i];
    ++size;
  }
  return size;
}

static uint32_t show_exponent(char * to, int32_t exponent)
{
  const uint32_t size = exponent < 0 ? 0u - (uint32_t)exponent : (uint32_t)exponent;
  uint32_t at = show_text(to, exponent < 0 ? "e-" : "e+");

  if (size < 10u) {
    to[at] = '0';
    ++at;
  }
  return at + rclc_parameter_show_integer(&to[at], (int64_t)size);
}

static uint32_t show_positive(char * to, double value)
{
  show_number_t number;

  show_split(value, &number);
  if (number.exponent < SHOW_LEAST || number.exponent >= SHOW_DIGITS) {
    const uint32_t size = show_digits(to, &number, 0, 1);
    return size + show_exponent(&to[size], number.exponent);
  }
  return show_digits(to, &number, number.exponent < 0 ? number.exponent : 0, number.exponent + 1);
}

uint32_t rclc_parameter_show_double(char * to, double value)
{
  const bool is_negative = value < 0.0;
  const double magnitude = is_negative ? -value : value;
  uint32_t size = 0;

  if (is_negative) {
    to[size] = '-';
    ++size;
  }
  if (!(magnitude >= 0.0)) {
    return size + show_text(&to[size], "nan");
  }
  if (!(magnitude > 0.0)) {
    return size + show_text(&to[size], "0");
  }
  if (magnitude > magnitude / 2.0) {
    return size + show_positive(&to[size], magnitude);
  }
  return size + show_text(&to[size], "inf");
}

#endif
