/* SPDX-License-Identifier: Apache-2.0 */
/* Floating-point numbers of rcutils_logging_format against the C library's vsnprintf. */
#define UNIT_TEXT_SIZE 1600

#include "unit.h"
#include "unit_log_compare.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { RANDOM = 150 };

static uint64_t state = 88172645463325252u;

static uint64_t draw(void)
{
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return state;
}

static double of_bits(uint64_t bits)
{
  double value = 0.0;

  (void)memcpy(&value, &bits, sizeof(value));
  return value;
}

/* Every flag, width, precision and kind. */
static void in_all_forms(double value)
{
  static const char * const forms[] = {"",     ".0",  ".",     ".1",   ".3",   ".10", ".17",  ".40",
                                       "12",   "-12", "+",     " ",    "012",  "#",   "#.0",  "+09.2",
                                       "-9.2", "# 8", "-+#.3", "25.9", "-025", "1.1", ".760", "+-030.4"};
  static const char kinds[] = "fFeEgG";

  for (size_t i = 0; i < sizeof(forms) / sizeof(forms[0]); ++i) {
    for (size_t k = 0; kinds[k] != '\0'; ++k) {
      char format[32];

      (void)snprintf(format, sizeof(format), "a%%%s%cz %%d", forms[i], kinds[k]);
      compare(format, value, 42);
    }
  }
}

static void edges(void)
{
  static const double values[] = {
    0.0,        1.0,       0.5,    1.5,      2.5,      0.125,        0.25,     9.5,        99.5,
    999999.4,   9.9999995, 1e-4,   9.9e-5,   9.9995e3, 99999.95,     123456.5, 1e15,       1e16,
    1e22,       1e23,      1e100,  0.1,      0.3,      1.0 / 3,      100.0,    1000000.0,  3.14159265,
    DBL_MAX,    DBL_MIN,   5e-324, 1.7e-310, 65535.5,  4294967296.0, 1e9,      9999.0,     10000.0,
    99999999.4, 0.05,      0.95,   0.995,    0.9995,   1e-7,         1e300,    DBL_EPSILON};

  for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); ++i) {
    in_all_forms(values[i]);
    in_all_forms(-values[i]);
  }
  in_all_forms((double)INFINITY);
  in_all_forms(-(double)INFINITY);
  in_all_forms((double)NAN);
  in_all_forms(-(double)NAN);
}

/* Any bits, and numbers as programs have them: few decimals, floats, halves of a last digit. */
static void drawn(void)
{
  for (unsigned i = 0; i < RANDOM; ++i) {
    const double some = (double)(int64_t)(draw() >> 40);

    in_all_forms(of_bits(draw()));
    in_all_forms(some / 1000.0);
    in_all_forms((double)(float)(some / 4096.0));
    in_all_forms((some * 2.0 + 1.0) / (double)(1u << (draw() % 30u)));
  }
}

static void others(void)
{
  for (int number = -12; number < 13; ++number) {
    compare("[%*.*f|%d]", number, number, 2.0 / 3, 7);
  }
  compare("%g %e %G", 999999.5, 999999.5, -999999.5); /* not %#g: glibc loses the zeros where rounding carries */
  compare("%Lf %Lg %d", 0.1L + 0.4L, (long double)1e10, 7);
}

static size_t formatted(char * text, size_t size, const char * format, ...)
{
  size_t length = 0;
  va_list args;

  va_start(args, format);
  length = rcutils_logging_format(text, size, format, &args);
  va_end(args);
  return length;
}

/* What is bounded by the text, and what is left as it stands. */
static void bounded(void)
{
  char text[16];

  CHECK(formatted(text, sizeof(text), "%.4000f", 0.1) == sizeof(text) - 1u);
  CHECK(strcmp(text, "0.1000000000...") == 0);
  CHECK(formatted(text, sizeof(text), "%a %d", 1.0, 7) == 4u);
  CHECK(strcmp(text, "%a 7") == 0);
}

int main(void)
{
  edges();
  drawn();
  others();
  bounded();
  return compare_end();
}
