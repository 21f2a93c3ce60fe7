/* SPDX-License-Identifier: Apache-2.0 */
/* The log writer `rosout`. */
#ifndef MICROROS_RCUTILS_ROSOUT_H
#define MICROROS_RCUTILS_ROSOUT_H

#include <stdbool.h>
#include <stdint.h>

#include "rcutils/logging.h"

/* Keeps a message of at least the level of /rosout until it is sent. Takes from `args`. */
void microros_rosout_log(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args);

/* Keeps a line of the library for /rosout alone, whatever the levels are: `number`, unless it is 0, and `words`. Under the
 * lock of the session. Returns false without room for it. */
bool microros_rosout_say(
  int severity, const char * name, rcutils_time_point_value_t timestamp, uint32_t number, const char * words);

#endif /* MICROROS_RCUTILS_ROSOUT_H */
