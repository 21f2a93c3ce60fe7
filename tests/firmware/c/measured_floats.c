/* SPDX-License-Identifier: Apache-2.0 */
/* Formats floating-point numbers of the worst kinds, each between two marks, without what reads the format. */
#include "measured.h"

#include <float.h>
#include <microros/rcutils_format_float.h>
#include <rclc/rclc.h>
#include <rcutils/logging.h>
#include <stdarg.h>

enum { LINE = 192, PRECISION_MOST = 4095 };

static volatile bool is_running;
static char line[LINE];

__attribute__((noinline)) static void formatted(char kind, int32_t precision, ...)
{
  const microros_conversion_t how = {false, false, true, false, true, PRECISION_MOST, precision, '\0', kind};
  microros_format_t out = {line, sizeof(line), 0, false};
  va_list args;

  va_start(args, precision);
  mark();
  (void)microros_format_floating(&out, &how, &args);
  mark();
  va_end(args);
}

static void floats_measure(double value)
{
  formatted('f', -1, value);
  formatted('f', PRECISION_MOST, value);
  formatted('e', PRECISION_MOST, value);
  formatted('g', PRECISION_MOST, value);
  formatted('g', 0, value);
}

int main(void)
{
  if (is_running) { /* the tool compares the plan of an image with that of its library */
    rcl_allocator_t allocator = rcl_get_default_allocator();
    rclc_support_t support;

    (void)rclc_support_init(&support, 0, NULL, &allocator);
    (void)rcutils_logging_format(line, sizeof(line), "", NULL);
  }
  floats_measure(0.0);
  floats_measure(-DBL_MAX);
  floats_measure(DBL_MIN / 4503599627370496.0);  /* the smallest one */
  floats_measure(DBL_MIN * (2.0 - DBL_EPSILON)); /* the most digits after the point */
  floats_measure(0x1.fffffffffffffp-14);         /* of those that g does not put with an exponent */
  floats_measure(0.99999999999999988898);
  finish();
  return 0;
}
