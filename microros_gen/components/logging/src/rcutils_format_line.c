/* SPDX-License-Identifier: Apache-2.0 */
/* Lines like `[INFO] [1700000000.123456789] [arm]: text`, as ROS 2 prints them, and what was lost of others. */
#include "microros/lock.h"
#include "microros/rcutils_format.h"
#include "microros/text.h"
#include "rcutils/logging.h"

enum { SECOND_DIGITS = 10, FRACTION_DIGITS = 9 };

/* Returns the name of a level, of the next lower one for a number between two levels. Shorter than
 * g_rcutils_log_severity_names, which has a place for each number. */
static const char * line_level(int severity)
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

/* Puts a time of day as seconds: 1700000000.123456789. */
static void line_time(microros_format_t * out, int64_t time)
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
  microros_format_string(out, line_level(severity));
  microros_format_string(out, "] [");
  line_time(out, time);
  microros_format_string(out, "] [");
  microros_format_string(out, name);
  microros_format_string(out, "]: ");
}

enum { MARK_SIZE = 3, UTF8_MORE = 3 }; /* bytes of a character after its first one */

static rcutils_logging_counts_t format_counts;

rcutils_logging_counts_t rcutils_logging_get_counts(void)
{
  rcutils_logging_counts_t counts;

  microros_lock();
  counts = format_counts;
  microros_unlock();
  return counts;
}

void microros_format_dropped(void)
{
  microros_lock();
  ++format_counts.dropped;
  microros_unlock();
}

void microros_format_end(microros_format_t * out)
{
  const size_t marks = out->used < MARK_SIZE ? out->used : MARK_SIZE;

  if (!out->truncated) {
    return;
  }
  microros_lock();
  ++format_counts.truncated;
  microros_unlock();
  /* Not in the middle of a character of UTF-8, which ROS would refuse to read. */
  /* at most UTF8_MORE rounds */
  for (uint32_t left = UTF8_MORE;
       left != 0u && out->used > marks && ((uint8_t)out->text[out->used - marks] & 0xc0u) == 0x80u; --left) {
    --out->used;
  }
  for (size_t i = 1; i <= marks; ++i) { /* at most MARK_SIZE rounds */
    out->text[out->used - i] = '.';
  }
}

size_t rcutils_logging_format(char * text, size_t size, const char * format, va_list * args)
{
  microros_format_t out = {text, size - 1u, 0, false};

  if (text == NULL || size == 0u || format == NULL || args == NULL) {
    return 0;
  }
  microros_format_arguments(&out, format, args);
  microros_format_end(&out);
  text[out.used] = '\0';
  return out.used;
}

enum { MESSAGE_TIME_SIZE = 32, MESSAGE_BRACKETS = sizeof("[] [] []: ") };

/* Appends `text` in front of `after`; the buffer has room. */
static rcutils_ret_t message_append(rcutils_char_array_t * array, const char * text, const char * after)
{
  const rcutils_ret_t ret = rcutils_char_array_strcat(array, text);

  return ret == RCUTILS_RET_OK ? rcutils_char_array_strcat(array, after) : ret;
}

rcutils_ret_t rcutils_logging_format_message(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * msg, rcutils_char_array_t * logging_output)
{
  const char * const logger = name == NULL ? "" : name;
  char time[MESSAGE_TIME_SIZE];
  microros_format_t out = {time, sizeof(time) - 1u, 0, false};
  const char * const level = line_level(severity);
  size_t size = MESSAGE_BRACKETS;
  rcutils_ret_t ret;

  (void)location; /* not part of the format */
  if (msg == NULL || logging_output == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  line_time(&out, timestamp);
  time[out.used] = '\0';
  size += microros_text_size(level) + out.used + microros_text_size(logger) + microros_text_size(msg);
  size += logging_output->buffer == NULL ? 0u : microros_text_size(logging_output->buffer);
  ret = rcutils_char_array_expand_as_needed(logging_output, size);
  if (ret == RCUTILS_RET_OK) {
    ret = message_append(logging_output, "[", level);
  }
  if (ret == RCUTILS_RET_OK) {
    ret = message_append(logging_output, "] [", time);
  }
  if (ret == RCUTILS_RET_OK) {
    ret = message_append(logging_output, "] [", logger);
  }
  return ret == RCUTILS_RET_OK ? message_append(logging_output, "]: ", msg) : ret;
}
