/* SPDX-License-Identifier: Apache-2.0 */
/* Floating-point numbers in log messages. Internal. */
#ifndef MICROROS_RCUTILS_FORMAT_FLOAT_H
#define MICROROS_RCUTILS_FORMAT_FLOAT_H

#include "microros/rcutils_format.h"

/*
 * Takes a floating-point argument and prints it like printf, with all of its digits (f, F, e, E, g, G); a long double
 * is rounded to a double first. Returns false for other conversions, which are printed unchanged. Needs about 600
 * bytes of stack.
 */
bool microros_format_floating(microros_format_t * out, const microros_conversion_t * how, va_list * args);

#endif /* MICROROS_RCUTILS_FORMAT_FLOAT_H */
