/* SPDX-License-Identifier: Apache-2.0 */
/* The log writer `rosout`. */
#ifndef MICROROS_RCUTILS_ROSOUT_H
#define MICROROS_RCUTILS_ROSOUT_H

#include "rcutils/logging.h"

/* Keeps a message of at least the level of /rosout until it is sent. Takes from `args`. */
void microros_rosout_log(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args);

/* Says how many lines were dropped, if any were and this has room. With the lock. */
void microros_rosout_report(void);

/* Keeps a message whose text is ready, after microros_rosout_report: with the lock. */
void microros_rosout_text(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * text);

/* Keeps it until it is sent, whatever its level. */
void microros_rosout_publish(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * text);

#endif /* MICROROS_RCUTILS_ROSOUT_H */
