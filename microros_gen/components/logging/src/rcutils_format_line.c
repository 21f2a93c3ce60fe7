/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of `[INFO] [1700000000.123456789] [arm]: text`, as ROS 2 prints them. */
#include "microros/rcutils_format.h"
#include "rcutils/logging.h"

enum { SECOND_DIGITS = 10, FRACTION_DIGITS = 9 };

/* Shorter than g_rcutils_log_severity_names, which has a place for each number. */
const char * microros_format_level(int severity)
{
  if (severity >= RCUTILS_LOG_SEVERITY_FATAL) {
    return "FATAL";
  }
  if (severity >= RCUTILS_LOG_SEVERITY_ERROR) {
    return "ERROR";
  }
  if (severity >= RCUTILS_LOG_SEVERITY_WARN) {
    return "WARN";
  }
  return severity >= RCUTILS_LOG_SEVERITY_INFO ? "INFO" : "DEBUG";
}

static void line_digits(microros_format_t * out, uint64_t number, int32_t digits)
{
  const microros_conversion_t how = {false, true, false, false, false, digits, -1, '\0', 'u'};

  microros_format_integer(out, &how, number, false);
}

void microros_format_time(microros_format_t * out, int64_t time)
{
  const bool negative = time < 0;
  uint32_t nanoseconds;
  uint64_t seconds;

  if (negative) {
    microros_format_put(out, '-');
  }
  seconds = microros_format_seconds(negative ? -(time < -INT64_MAX ? -INT64_MAX : time) : time, &nanoseconds);
  line_digits(out, seconds, SECOND_DIGITS);
  microros_format_put(out, '.');
  line_digits(out, nanoseconds, FRACTION_DIGITS);
}

void microros_format_begin(microros_format_t * out, int severity, const char * name, int64_t time)
{
  microros_format_put(out, '[');
  microros_format_string(out, microros_format_level(severity));
  microros_format_string(out, "] [");
  microros_format_time(out, time);
  microros_format_string(out, "] [");
  microros_format_string(out, name);
  microros_format_string(out, "]: ");
}
