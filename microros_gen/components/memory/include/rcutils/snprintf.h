/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Formatting under the names of rcutils, by the C library of the calling application; this library uses no
 * stdio. Both write at most `buffer_size` bytes including the NUL, and return the length of the whole text
 * without it. NULL and 0 return the length only; NULL with another size, or without a format, returns -1.
 */
#ifndef MICROROS_RCUTILS_SNPRINTF_H
#define MICROROS_RCUTILS_SNPRINTF_H

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include "rcutils/macros.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline int rcutils_vsnprintf(char * buffer, size_t buffer_size, const char * format, va_list args)
{
  if (format == NULL || (buffer == NULL) != (buffer_size == 0u)) {
    return -1;
  }
  return vsnprintf(buffer, buffer_size, format, args);
}

static inline int rcutils_snprintf(char * buffer, size_t buffer_size, const char * format, ...)
{
  va_list args;
  int size;

  va_start(args, format);
  size = rcutils_vsnprintf(buffer, buffer_size, format, args);
  va_end(args);
  return size;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_SNPRINTF_H */
