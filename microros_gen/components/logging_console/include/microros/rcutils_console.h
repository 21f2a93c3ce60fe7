/* SPDX-License-Identifier: Apache-2.0 */
/* The log writer `console`. */
#ifndef MICROROS_RCUTILS_CONSOLE_H
#define MICROROS_RCUTILS_CONSOLE_H

#include "rcutils/logging.h"

/* Writes a message of at least the console's level. Takes from `args`. */
void microros_console_log(
  int severity, const char * name, rcutils_time_point_value_t timestamp, const char * format, va_list * args);

/* Called in each pump: reports dropped messages as soon as the console takes a line, even if nothing more is logged. */
void microros_console_report(void);

/* Writes a message whose text is ready, after microros_console_report: with the lock. */
void microros_console_text(
  int severity, const char * name, rcutils_time_point_value_t timestamp, const char * text);

#endif /* MICROROS_RCUTILS_CONSOLE_H */
