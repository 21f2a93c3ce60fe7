/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Formatting, under the names of rcutils: the C library's, in the application that calls these; this library has no stdio.
 * Both write at most `buffer_size` bytes, the NUL included, and return how long the whole text is without it. NULL and 0 ask
 * for the length alone; NULL with another size, or no format, returns -1.
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
