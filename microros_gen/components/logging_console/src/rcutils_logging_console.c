/* SPDX-License-Identifier: Apache-2.0 */
/* Lines of the console: `[INFO] [1700000000.123456789] [arm]: text`, as ROS 2 writes them. */
#include "microros/epoch.h"
#include "microros/lock.h"
#include "microros/port_console.h"
#include "microros/rcutils_console.h"
#include "microros/rcutils_console_hooks.h"
#include "microros/rcutils_console_wake.h"
#include "microros/rcutils_format.h"
#include "microros_config.h"

enum { CONSOLE_REPORT_SIZE = 96, CONSOLE_AGAIN_MS = 1000 };

static uint32_t console_unreported; /* dropped since the last line that was written */

/* Ends the line, for which one character was kept. */
static void console_end(microros_format_t * out)
{
  microros_format_end(out);
  out->text[out->used] = '\n';
}

/* Says once how many messages the console did not take. */
static void console_report_dropped(char * text, size_t size, rcutils_time_point_value_t timestamp)
{
  const microros_conversion_t number = {false, false, false, false, false, 0, -1, '\0', 'u'};
  microros_format_t out = {text, size, 0, false};

  if (console_unreported == 0u) {
    return;
  }
  microros_format_begin(&out, RCUTILS_LOG_SEVERITY_WARN, "rcutils", timestamp);
  microros_format_integer(&out, &number, console_unreported, false);
  microros_format_string(&out, " messages dropped");
  console_end(&out);
  if (port_console_write(text, out.used + 1u)) {
    console_unreported = 0;
  }
}

void microros_console_report(void)
{
  if (console_unreported != 0u) {
    char text[CONSOLE_REPORT_SIZE];

    console_report_dropped(text, sizeof(text) - 1u, microros_epoch_known_ns());
  }
}

uint32_t microros_console_left(uint32_t left)
{
  return console_unreported != 0u && left > (uint32_t)CONSOLE_AGAIN_MS ? (uint32_t)CONSOLE_AGAIN_MS : left;
}

/* The lock is held. */
static void console_drop(void)
{
  microros_format_dropped();
  ++console_unreported;
  if (console_unreported == 1u) {
    microros_console_wake();
  }
}

/* Tells, with `text` as room for the report, whether a line may follow; counts the line as dropped if not. */
static bool console_accepts(char * text, size_t size, rcutils_time_point_value_t timestamp)
{
  bool accepts;

  microros_lock();
  console_report_dropped(text, size, timestamp);
  accepts = console_unreported == 0u;
  if (!accepts) {
    console_drop();
  }
  microros_unlock();
  return accepts;
}

/* Writes a line; drops it where it does not fit, or another task's line was dropped meanwhile and comes first. */
static void console_write(const char * text, size_t size)
{
  microros_lock();
  if (console_unreported != 0u || !port_console_write(text, size)) {
    console_drop();
  }
  microros_unlock();
}

void rcutils_logging_console_output_handler(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  char text[MICROROS_LOG_TEXT_SIZE];
  microros_format_t out = {text, sizeof(text) - 1u, 0, false};

  (void)location; /* ROS 2 does not write it either unless it is asked to */
  if (!console_accepts(text, sizeof(text) - 1u, timestamp)) {
    return;
  }
  microros_format_begin(&out, severity, name == NULL ? "" : name, timestamp);
  microros_format_arguments(&out, format, args); /* without the lock: arguments may be of any length */
  console_end(&out);
  console_write(text, out.used + 1u);
}

void microros_console_log(
  int severity, const char * name, rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  if (severity >= (int)MICROROS_LOG_CONSOLE_LEVEL) {
    rcutils_logging_console_output_handler(NULL, severity, name, timestamp, format, args);
  }
}

void microros_console_text(
  int severity, const char * name, rcutils_time_point_value_t timestamp, const char * text)
{
  char line[MICROROS_LOG_TEXT_SIZE];
  microros_format_t out = {line, sizeof(line) - 1u, 0, false};

  if (severity < (int)MICROROS_LOG_CONSOLE_LEVEL) {
    return;
  }
  microros_format_begin(&out, severity, name, timestamp);
  microros_format_string(&out, text);
  console_end(&out);
  console_write(line, out.used + 1u);
}
