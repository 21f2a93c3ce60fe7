/* SPDX-License-Identifier: Apache-2.0 */
/* Lines of the console: `[INFO] [1700000000.123456789] [arm]: text`, as ROS 2 writes them. */
#include "microros/lock.h"
#include "microros/port_console.h"
#include "microros/rcutils_console.h"
#include "microros/rcutils_format.h"
#include "microros_config.h"

enum { CONSOLE_TIME_DIGITS = 9 };

static uint32_t console_unreported; /* dropped since the last line that was written */

/* Shorter than g_rcutils_log_severity_names, which has a place for each number. */
static const char * console_level(int severity)
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

static void console_time(microros_format_t * out, rcutils_time_point_value_t timestamp)
{
  const microros_conversion_t seconds = {false, false, false, false, false, 0, -1, '\0', 'u'};
  const microros_conversion_t fraction = {
    false, true, false, false, false, CONSOLE_TIME_DIGITS, -1, '\0', 'u'};
  uint32_t nanoseconds;

  microros_format_integer(out, &seconds, microros_format_seconds(timestamp, &nanoseconds), false);
  microros_format_put(out, '.');
  microros_format_integer(out, &fraction, nanoseconds, false);
}

static void console_begin(
  microros_format_t * out, int severity, const char * name, rcutils_time_point_value_t timestamp)
{
  microros_format_put(out, '[');
  microros_format_string(out, console_level(severity));
  microros_format_string(out, "] [");
  console_time(out, timestamp);
  microros_format_string(out, "] [");
  microros_format_string(out, name);
  microros_format_string(out, "]: ");
}

/* Ends the line, for which one character was kept. */
static bool console_end(microros_format_t * out)
{
  microros_format_end(out);
  out->text[out->used] = '\n';
  return port_console_write(out->text, out->used + 1u);
}

/* Says once how many messages the console did not take. */
static void console_report_dropped(char * text, size_t size, rcutils_time_point_value_t timestamp)
{
  const microros_conversion_t number = {false, false, false, false, false, 0, -1, '\0', 'u'};
  microros_format_t out = {text, size, 0, false};

  if (console_unreported == 0u) {
    return;
  }
  console_begin(&out, RCUTILS_LOG_SEVERITY_WARN, "rcutils", timestamp);
  microros_format_integer(&out, &number, console_unreported, false);
  microros_format_string(&out, " messages dropped");
  if (console_end(&out)) {
    console_unreported = 0;
  }
}

static void console_write(
  int severity, const char * name, rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  char text[MICROROS_LOG_TEXT_SIZE];
  microros_format_t out = {text, sizeof(text) - 1u, 0, false};

  console_report_dropped(text, sizeof(text) - 1u, timestamp);
  console_begin(&out, severity, name, timestamp);
  microros_format_arguments(&out, format, args);
  if (console_unreported != 0u || !console_end(&out)) {
    microros_format_dropped();
    ++console_unreported;
  }
}

void rcutils_logging_console_output_handler(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  (void)location; /* ROS 2 does not write it either unless it is asked to */
  microros_lock();
  console_write(severity, name == NULL ? "" : name, timestamp, format, args);
  microros_unlock();
}

void microros_console_log(
  int severity, const char * name, rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  if (severity >= (int)MICROROS_LOG_CONSOLE_LEVEL) {
    rcutils_logging_console_output_handler(NULL, severity, name, timestamp, format, args);
  }
}
