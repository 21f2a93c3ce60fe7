/* SPDX-License-Identifier: Apache-2.0 */
/* Without floating-point numbers in log messages (component logging_float). */
#ifndef MICROROS_RCUTILS_FORMAT_FLOAT_H
#define MICROROS_RCUTILS_FORMAT_FLOAT_H

#include "microros/rcutils_format.h"

/* Takes a floating-point argument; returns false, so that its conversion is printed unchanged. */
static inline bool microros_format_floating(
  microros_format_t * out, const microros_conversion_t * how, va_list * args)
{
  (void)out;
  if (how->length == 'L') {
    (void)va_arg(*args, long double);
  } else {
    (void)va_arg(*args, double);
  }
  return false;
}

#endif /* MICROROS_RCUTILS_FORMAT_FLOAT_H */
