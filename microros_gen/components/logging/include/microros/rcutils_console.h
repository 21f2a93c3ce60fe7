/* SPDX-License-Identifier: Apache-2.0 */
/* Without the log writer `console` (component logging_console): does nothing. */
#ifndef MICROROS_RCUTILS_CONSOLE_H
#define MICROROS_RCUTILS_CONSOLE_H

#include "rcutils/logging.h"

static inline void microros_console_log(
  int severity, const char * name, rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  (void)severity;
  (void)name;
  (void)timestamp;
  (void)format;
  (void)args;
}

static inline void microros_console_report(void)
{
}

static inline void microros_console_text(
  int severity, const char * name, rcutils_time_point_value_t timestamp, const char * text)
{
  (void)severity;
  (void)name;
  (void)timestamp;
  (void)text;
}

#endif /* MICROROS_RCUTILS_CONSOLE_H */
