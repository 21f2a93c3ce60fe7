/* SPDX-License-Identifier: Apache-2.0 */
/* rcutils_logging_format against the C library's vsnprintf, for every combination of what a conversion can have. */
#define UNIT_TEXT_SIZE 160

#include "unit.h"
#include "unit_log_compare.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <wchar.h>

enum { FLAGS = 5 };

/* Writes `before%<flags><width><precision><length><kind>after`. */
static const char * made(
  unsigned flags, const char * allowed, const char * width, const char * precision, const char * length,
  char kind)
{
  static char format[64];
  char chosen[FLAGS + 1];
  size_t count = 0;

  for (size_t i = 0; allowed[i] != '\0'; ++i) {
    if ((flags >> i & 1u) != 0u) {
      chosen[count] = allowed[i];
      ++count;
    }
  }
  chosen[count] = '\0';
  (void)snprintf(format, sizeof(format), "a%%%s%s%s%s%cz%%%%", chosen, width, precision, length, kind);
  return format;
}

static const char * const widths[] = {"", "1", "7", "30"};
static const char * const precisions[] = {"", ".", ".0", ".3", ".25"};

static void integers_of(const char * format, const char * length, long long value)
{
  if (strcmp(length, "ll") == 0) {
    compare(format, value);
  } else if (strcmp(length, "l") == 0) {
    compare(format, (long)value);
  } else if (strcmp(length, "z") == 0 || strcmp(length, "t") == 0) {
    compare(format, (size_t)value);
  } else if (strcmp(length, "j") == 0) {
    compare(format, (intmax_t)value);
  } else {
    compare(format, (int)value);
  }
}

static void integers(char kind, const char * allowed)
{
  static const char * const lengths[] = {"hh", "h", "", "l", "ll", "z", "j", "t"};
  static const long long values[] = {0,         1,        -1,    9,         10,        255,
                                     -128,      65535,    65536, INT32_MAX, INT32_MIN, 1700000000123456789,
                                     INT64_MAX, INT64_MIN};

  for (unsigned flags = 0; flags < 1u << strlen(allowed); ++flags) {
    for (size_t w = 0; w < sizeof(widths) / sizeof(widths[0]); ++w) {
      for (size_t p = 0; p < sizeof(precisions) / sizeof(precisions[0]); ++p) {
        for (size_t l = 0; l < sizeof(lengths) / sizeof(lengths[0]); ++l) {
          for (size_t v = 0; v < sizeof(values) / sizeof(values[0]); ++v) {
            integers_of(
              made(flags, allowed, widths[w], precisions[p], lengths[l], kind), lengths[l], values[v]);
          }
        }
      }
    }
  }
}

static void texts(void)
{
  static const char * const values[] = {"", "a", "motor", "a longer text of some words", NULL};

  for (unsigned flags = 0; flags < 2u; ++flags) {
    for (size_t w = 0; w < sizeof(widths) / sizeof(widths[0]); ++w) {
      for (size_t p = 0; p < sizeof(precisions) / sizeof(precisions[0]); ++p) {
        for (size_t v = 0; v < sizeof(values) / sizeof(values[0]); ++v) {
          compare(made(flags, "-", widths[w], precisions[p], "", 's'), values[v]);
        }
      }
      compare(made(flags, "-", widths[w], "", "", 'c'), 'x');
      compare(made(flags, "-", widths[w], "", "", 'p'), (void *)0);
      compare(made(flags, "-", widths[w], "", "", 'p'), (void *)&compared);
    }
  }
}

static void stars(void)
{
  for (int number = -12; number < 13; ++number) {
    compare("[%*d]", number, 42);
    compare("[%.*d]", number, 42);
    compare("[%0*.*x|%-*s]", number, number, 42u, number, "abc");
  }
}

static const char * formatted(char * text, size_t size, const char * format, ...)
{
  va_list args;

  va_start(args, format);
  CHECK(rcutils_logging_format(text, size, format, &args) == strlen(text));
  va_end(args);
  return text;
}

/* Conversions of floating point stand as they are, and the argument after them is found. */
static void floats(void)
{
  char text[UNIT_TEXT_SIZE];

  CHECK(strcmp(formatted(text, sizeof(text), "%.2f %d", 1.5, 7), "%.2f 7") == 0);
  CHECK(strcmp(formatted(text, sizeof(text), "%-8Lg|%s", (long double)2, "b"), "%-8Lg|b") == 0);
}

/* What an unknown conversion takes is unknown: the rest stands as it is. */
static void unknown(void)
{
  char text[UNIT_TEXT_SIZE];

  CHECK(strcmp(formatted(text, sizeof(text), "%d %k %d", 1, 2, 3), "1 %k %d") == 0);
  CHECK(strcmp(formatted(text, sizeof(text), "%d %-4ls %d", 1, L"ab", 3), "1 %-4ls %d") == 0);
  CHECK(strcmp(formatted(text, sizeof(text), "%d %lc %d", 1, (wint_t)L'a', 3), "1 %lc %d") == 0);
  CHECK(strcmp(formatted(text, sizeof(text), "%d %", 1), "1 %") == 0);
}

static void truncated(void)
{
  char text[8];
  const uint32_t before = rcutils_logging_get_counts().truncated;

  CHECK(strcmp(formatted(text, sizeof(text), "%s", "sevench"), "sevench") == 0);
  CHECK(rcutils_logging_get_counts().truncated == before);
  CHECK(strcmp(formatted(text, sizeof(text), "%s", "eightchr"), "eigh...") == 0);
  CHECK(strcmp(formatted(text, sizeof(text), "%4095d", 1), "    ...") == 0);
  CHECK(strcmp(formatted(text, 3, "%s", "abcd"), "..") == 0);
  CHECK(strcmp(formatted(text, 1, "%s", "abcd"), "") == 0);
  CHECK(rcutils_logging_get_counts().truncated == before + 4u);
}

int main(void)
{
  integers('d', "-0+ ");
  integers('i', "-0+ ");
  integers('u', "-0");
  integers('x', "-0#");
  integers('X', "-0#");
  integers('o', "-0#");
  texts();
  stars();
  compare("");
  compare("100%% of %s%c", "it", '.');
  floats();
  unknown();
  truncated();
  return compare_end();
}
