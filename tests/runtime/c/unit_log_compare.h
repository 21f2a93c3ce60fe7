/* SPDX-License-Identifier: Apache-2.0 */
/* Compares rcutils_logging_format with the C library's vsnprintf. UNIT_TEXT_SIZE: bytes of the longest text. */
#ifndef UNIT_LOG_COMPARE_H
#define UNIT_LOG_COMPARE_H

#include "rcutils/logging.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The formats are made by the tests. */
#pragma GCC diagnostic ignored "-Wformat-nonliteral"

static unsigned compared;
static unsigned wrong;

static void compare(const char * format, ...)
{
  char own[UNIT_TEXT_SIZE];
  char expected[UNIT_TEXT_SIZE];
  va_list args;
  va_list again;
  size_t size = 0;
  int expected_size = 0;

  va_start(args, format);
  va_copy(again, args);
  size = rcutils_logging_format(own, sizeof(own), format, &args);
  expected_size = vsnprintf(expected, sizeof(expected), format, again);
  va_end(again);
  va_end(args);
  ++compared;
  if ((int)size != expected_size || strcmp(own, expected) != 0) {
    ++wrong;
    (void)fprintf(stderr, "'%s': '%s', expected '%s'\n", format, own, expected);
  }
}

/* Says how many texts were compared; returns the status of the program. */
static int compare_end(void)
{
  (void)printf("%u compared\n", compared);
  return wrong == 0u ? 0 : 1;
}

#endif /* UNIT_LOG_COMPARE_H */
