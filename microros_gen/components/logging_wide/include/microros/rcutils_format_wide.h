/* SPDX-License-Identifier: Apache-2.0 */
/* Wide characters in log messages. Internal. */
#ifndef MICROROS_RCUTILS_FORMAT_WIDE_H
#define MICROROS_RCUTILS_FORMAT_WIDE_H

#include "microros/rcutils_format.h"

/*
 * Puts the argument of `lc` or `ls` as UTF-8: a wide character is a code point, and what is none becomes U+FFFD.
 * Width and precision are bytes; the precision cuts no character in two. Returns true. */
bool microros_format_wide(microros_format_t * out, const microros_conversion_t * how, va_list * args);

#endif /* MICROROS_RCUTILS_FORMAT_WIDE_H */
