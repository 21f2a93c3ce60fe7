/* SPDX-License-Identifier: Apache-2.0 */
/* Ranges of doubles, as rclcpp checks them. */
#include "microros/rclc_parameters.h"

#include <float.h>

static double floating_magnitude(double value)
{
  return value < 0.0 ? -value : value;
}

/* As rclcpp compares: 100 times the precision of the two together. */
static bool floating_equals(double a, double b)
{
  return floating_magnitude(a - b) <= DBL_EPSILON * floating_magnitude(a + b) * 100.0;
}

/* Only linked where a parameter has such a range: a processor without a double unit needs a lot of code for it. */
bool rclc_parameter_floating_point_holds(const rclc_parameter_range_t * range, double value)
{
  const double whole_numbers = 9007199254740992.0; /* 2^53: from here on a double has no fraction */
  const double from = range->floating_point.from_value;
  const double step = range->floating_point.step;
  double steps;

  if (floating_equals(value, from) || floating_equals(value, range->floating_point.to_value)) {
    return true;
  }
  if (value < from || value > range->floating_point.to_value) {
    return false;
  }
  if (!(step > 0.0 || step < 0.0)) {
    return true;
  }
  steps = floating_magnitude((value - from) / step);
  if (steps < whole_numbers) {
    steps = (double)(int64_t)(steps + 0.5);
  }
  return floating_equals(value, from + steps * floating_magnitude(step));
}
