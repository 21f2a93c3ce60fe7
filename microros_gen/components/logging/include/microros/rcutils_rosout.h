/* SPDX-License-Identifier: Apache-2.0 */
/* Without the log writer `rosout` (component logging_rosout): does nothing. */
#ifndef MICROROS_RCUTILS_ROSOUT_H
#define MICROROS_RCUTILS_ROSOUT_H

#include "rcutils/logging.h"

static inline void microros_rosout_log(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  (void)location;
  (void)severity;
  (void)name;
  (void)timestamp;
  (void)format;
  (void)args;
}

static inline void microros_rosout_report(void)
{
}

static inline void microros_rosout_text(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * text)
{
  (void)location;
  (void)severity;
  (void)name;
  (void)timestamp;
  (void)text;
}

#endif /* MICROROS_RCUTILS_ROSOUT_H */
