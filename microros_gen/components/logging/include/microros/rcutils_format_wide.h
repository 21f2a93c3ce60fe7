/* SPDX-License-Identifier: Apache-2.0 */
/* Without wide characters in log messages (component logging_wide). */
#ifndef MICROROS_RCUTILS_FORMAT_WIDE_H
#define MICROROS_RCUTILS_FORMAT_WIDE_H

#include "microros/rcutils_format.h"

/* Returns false: `ls` and `lc` are unknown conversions. */
static inline bool microros_format_wide(
  microros_format_t * out, const microros_conversion_t * how, va_list * args)
{
  (void)out;
  (void)how;
  (void)args;
  return false;
}

#endif /* MICROROS_RCUTILS_FORMAT_WIDE_H */
