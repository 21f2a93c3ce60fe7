/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcutils_format.h"
#include "microros/text.h"
#include "rcutils/logging.h"

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
  const char * const level = microros_format_level(severity);
  size_t size = MESSAGE_BRACKETS;
  rcutils_ret_t ret;

  (void)location; /* not part of the format */
  if (msg == NULL || logging_output == NULL) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  microros_format_time(&out, timestamp);
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
