/* SPDX-License-Identifier: Apache-2.0 */
/* The conversions f, e and g: digits are counted and rounded first, put afterwards; none is kept. */
#include "microros/rcutils_format_float.h"

#include "microros/rcutils_format_digits.h"

#include <string.h>

enum {
  PRECISION_DEFAULT = 6,
  FIXED_LEAST = -4,
  EXPONENT_SIZE = 4,
  FLOAT_EXPONENT_BITS = 11,
  FLOAT_MANTISSA_BITS = 52
};

/*
 * Groups have 312 places before the point, and the smallest number begins 324 places after it: LEADING. A number has
 * 309 digits before the point, PRECISION_MOST after it (WIDTH_MOST of rcutils_format.c), and one more where rounding
 * carries over all of them: SHOWN.
 */
enum { PRECISION_MOST = 4095, LEADING = 312 + 324, SHOWN = 309 + PRECISION_MOST + 1 };

/* The digits of a number that are shown. Where rounding has carried over all of them, they are 1 and zeros. */
typedef struct float_shown_t {
  uint64_t bits;
  int32_t first; /* power of ten of the first one */
  int32_t count;
  int32_t raised; /* index of the digit that is one larger, after which all are 0 */
  int32_t last;   /* index of the last one that is not 0 */
  bool up;
  bool carried;
} float_shown_t;

/* How they are put. */
typedef struct float_layout_t {
  int32_t before; /* digits before the point */
  int32_t after;
  bool point;
  bool scientific;
  char sign; /* 0 without one */
} float_layout_t;

/* Returns the power of ten of the first digit that is not 0; 0 for the number 0. */
static int32_t float_first(microros_digits_t * digits, uint64_t bits)
{
  if (bits == 0u) {
    return 0;
  }
  microros_digits_begin(digits, bits);
  while (microros_digits_next(digits) == 0u) { /* at most LEADING rounds */
  }
  return digits->place + 1;
}

static void float_begin(microros_digits_t * digits, const float_shown_t * shown)
{
  microros_digits_begin(digits, shown->bits);
  while (digits->place > shown->first) { /* at most LEADING rounds */
    (void)microros_digits_next(digits);
  }
}

/* Rounds to the nearest, and in the middle to the even digit. */
static bool float_rounds_up(microros_digits_t * digits, uint32_t before)
{
  const uint32_t next = microros_digits_next(digits);

  if (next != 5u) {
    return next > 5u;
  }
  return !microros_digits_end(digits) || before % 2u != 0u;
}

/* Returns `count` digits from `first` on. */
static float_shown_t float_shown(microros_digits_t * digits, uint64_t bits, int32_t first, int32_t count)
{
  float_shown_t shown = {bits, first, count, -1, 0, false, false};
  uint32_t digit = 0;

  float_begin(digits, &shown);
  for (int32_t i = 0; i < count; ++i) { /* at most SHOWN rounds */
    digit = microros_digits_next(digits);
    shown.raised = digit != 9u ? i : shown.raised;
    shown.last = digit != 0u ? i : shown.last;
  }
  shown.up = float_rounds_up(digits, digit);
  if (shown.up) {
    shown.carried = shown.raised < 0;
    shown.last = shown.carried ? 0 : shown.raised;
  }
  return shown;
}

static uint32_t float_digit(const float_shown_t * shown, microros_digits_t * digits, int32_t index)
{
  uint32_t digit = 0;

  if (shown->carried) {
    return index == 0 ? 1u : 0u;
  }
  digit = microros_digits_next(digits);
  if (!shown->up || index < shown->raised) {
    return digit;
  }
  return index == shown->raised ? digit + 1u : 0u;
}

static float_shown_t float_fixed(microros_digits_t * digits, uint64_t bits, int32_t precision)
{
  const int32_t first = float_first(digits, bits);
  const int32_t whole = first < 0 ? 0 : first;
  float_shown_t shown = float_shown(digits, bits, whole, whole + 1 + precision);

  if (shown.carried) {
    ++shown.first;
    ++shown.count;
  }
  return shown;
}

static float_shown_t float_scientific(microros_digits_t * digits, uint64_t bits, int32_t precision)
{
  float_shown_t shown = float_shown(digits, bits, float_first(digits, bits), precision + 1);

  shown.first += shown.carried ? 1 : 0;
  return shown;
}

/* Chooses between the two ways, as g does. */
static float_shown_t float_general(
  microros_digits_t * digits, uint64_t bits, int32_t precision, float_layout_t * layout)
{
  const int32_t most = precision == 0 ? 1 : precision;
  const float_shown_t shown = float_scientific(digits, bits, most - 1);

  layout->scientific = shown.first < FIXED_LEAST || shown.first >= most;
  return layout->scientific ? shown : float_fixed(digits, bits, most - 1 - shown.first);
}

static float_shown_t float_choose(
  microros_digits_t * digits, char kind, uint64_t bits, int32_t precision, float_layout_t * layout)
{
  layout->scientific = kind == 'e';
  if (kind == 'g') {
    return float_general(digits, bits, precision, layout);
  }
  return kind == 'e' ? float_scientific(digits, bits, precision) : float_fixed(digits, bits, precision);
}

static float_shown_t float_read(
  microros_digits_t * digits, const microros_conversion_t * how, uint64_t bits, float_layout_t * layout)
{
  const char kind = (char)(how->kind | 0x20); /* in lower case */
  const int32_t precision = how->precision < 0 ? PRECISION_DEFAULT : how->precision;
  const float_shown_t shown = float_choose(digits, kind, bits, precision, layout);

  layout->before = layout->scientific ? 1 : shown.first + 1;
  layout->after = shown.count - layout->before;
  if (kind == 'g' && !how->alternative) {
    layout->after = shown.last < layout->before ? 0 : shown.last + 1 - layout->before;
  }
  layout->point = layout->after > 0 || how->alternative;
  return shown;
}

static void float_put_digits(
  microros_format_t * out, microros_digits_t * digits, const float_shown_t * shown,
  const float_layout_t * layout)
{
  float_shown_t from = *shown;

  from.first = shown->carried ? shown->first - 1 : shown->first;
  float_begin(digits, &from);
  for (int32_t i = 0; i < layout->before + layout->after; ++i) { /* at most SHOWN rounds */
    if (i == layout->before) {
      microros_format_put(out, '.');
    }
    microros_format_put(out, (char)('0' + (char)float_digit(shown, digits, i)));
  }
  if (layout->point && layout->after == 0) {
    microros_format_put(out, '.');
  }
}

/* At least two digits. */
static void float_put_exponent(microros_format_t * out, char letter, int32_t exponent)
{
  const microros_conversion_t how = {false, true, false, false, false, 2, -1, '\0', 'u'};

  microros_format_put(out, letter);
  microros_format_put(out, exponent < 0 ? '-' : '+');
  microros_format_integer(out, &how, (uint64_t)(uint32_t)(exponent < 0 ? -exponent : exponent), false);
}

static int32_t float_size(const float_shown_t * shown, const float_layout_t * layout)
{
  int32_t size = layout->before + layout->after;

  size += layout->point ? 1 : 0;
  size += layout->sign != '\0' ? 1 : 0;
  if (layout->scientific) {
    size += EXPONENT_SIZE;
    size += shown->first > 99 || shown->first < -99 ? 1 : 0;
  }
  return size;
}

static void float_put(
  microros_format_t * out, microros_digits_t * digits, const microros_conversion_t * how,
  const float_shown_t * shown, const float_layout_t * layout)
{
  const int32_t fill = how->width - float_size(shown, layout);

  if (!how->minus && !how->zero) {
    microros_format_repeat(out, ' ', fill);
  }
  if (layout->sign != '\0') {
    microros_format_put(out, layout->sign);
  }
  if (!how->minus && how->zero) {
    microros_format_repeat(out, '0', fill);
  }
  float_put_digits(out, digits, shown, layout);
  if (layout->scientific) {
    float_put_exponent(out, how->kind < 'a' ? 'E' : 'e', shown->first);
  }
  if (how->minus) {
    microros_format_repeat(out, ' ', fill);
  }
}

/* Infinities, and what is no number. */
static void float_put_word(
  microros_format_t * out, const microros_conversion_t * how, bool infinite, char sign)
{
  const bool upper = how->kind < 'a';
  const char * const word = infinite ? (upper ? "INF" : "inf") : (upper ? "NAN" : "nan");
  const int32_t fill = how->width - (sign != '\0' ? 4 : 3);

  microros_format_repeat(out, ' ', how->minus ? 0 : fill);
  if (sign != '\0') {
    microros_format_put(out, sign);
  }
  microros_format_string(out, word);
  microros_format_repeat(out, ' ', how->minus ? fill : 0);
}

static char float_sign(const microros_conversion_t * how, bool negative)
{
  if (negative) {
    return '-';
  }
  if (how->plus) {
    return '+';
  }
  return how->space ? ' ' : '\0';
}

bool microros_format_floating(microros_format_t * out, const microros_conversion_t * how, va_list * args)
{
  const uint64_t infinity = (((uint64_t)1 << (uint32_t)FLOAT_EXPONENT_BITS) - 1u)
                            << (uint32_t)FLOAT_MANTISSA_BITS;
  const double value = how->length == 'L' ? (double)va_arg(*args, long double) : va_arg(*args, double);
  float_layout_t layout = {0, 0, false, false, '\0'};
  uint64_t bits = 0;

  if (how->kind == 'a' || how->kind == 'A') {
    return false;
  }
  (void)memcpy(&bits, &value, sizeof(bits));
  layout.sign = float_sign(how, bits >> 63 != 0u);
  bits &= ((uint64_t)1 << 63) - 1u;
  if (bits >= infinity) {
    float_put_word(out, how, bits == infinity, layout.sign);
  } else {
    microros_digits_t digits;
    const float_shown_t shown = float_read(&digits, how, bits, &layout);

    float_put(out, &digits, how, &shown, &layout);
  }
  return true;
}
