/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lines for /rosout: encoded when they are logged, so that the message is no longer needed, and kept until they are
 * sent. Never waits: a line without room is dropped and counted, and the next line reports the number.
 */
#include "microros/cdr.h"
#include "microros/epoch.h"
#include "microros/lock.h"
#include "microros/rcutils_format.h"
#include "microros/rcutils_ring.h"
#include "microros/rcutils_rosout.h"
#include "microros/rcutils_rosout_hooks.h"
#include "microros/xrce_rosout.h"
#include "microros_config.h"
#include "rcl/logging_rosout.h"
#include "rcl_interfaces/msg/log.h"

#include <stddef.h>
#include <string.h>

enum { PATH_MOST = 1024 };

/* Has room for the largest line: all texts are bounded. */
typedef struct rosout_line_t {
  uint8_t body[rcl_interfaces__msg__Log__MAX_ENCODED_SIZE];
  uint32_t position;
} rosout_line_t;

static uint32_t rosout_unreported; /* dropped since the last line that had room */

static void rosout_align(rosout_line_t * line)
{
  while (line->position % 4u != 0u) { /* at most 3 rounds */
    line->body[line->position] = 0;
    ++line->position;
  }
}

static void rosout_number(rosout_line_t * line, uint32_t number)
{
  rosout_align(line);
  cdr_put_4(&line->body[line->position], &number);
  line->position += 4u;
}

/* Begins a text of up to `size` characters, which rosout_text_end puts into the line. */
static microros_format_t rosout_text_begin(rosout_line_t * line, size_t size)
{
  microros_format_t out = {NULL, size, 0, false};

  rosout_align(line);
  out.text = (char *)&line->body[line->position + 4u];
  return out;
}

static void rosout_text_end(rosout_line_t * line, microros_format_t * out)
{
  microros_format_end(out);
  out->text[out->used] = '\0';
  rosout_number(line, (uint32_t)out->used + 1u);
  line->position += (uint32_t)out->used + 1u;
}

static void rosout_text(rosout_line_t * line, const char * text, size_t size)
{
  microros_format_t out = rosout_text_begin(line, size);

  microros_format_string(&out, text);
  rosout_text_end(line, &out);
}

/* Keeps the end of a path that is too long, which says more than the beginning; of the first PATH_MOST characters. */
static void rosout_path(rosout_line_t * line, const char * path)
{
  size_t size = 0;
  size_t from = 0;

  while (size < (size_t)PATH_MOST && path[size] != '\0') { /* at most PATH_MOST rounds */
    ++size;
  }
  from = size > MICROROS_LOG_ROSOUT_FILE ? size - MICROROS_LOG_ROSOUT_FILE : 0u;

  /* at most 3 rounds */
  for (uint32_t left = 3; left != 0u && ((uint8_t)path[from] & 0xc0u) == 0x80u; --left) {
    ++from; /* not in the middle of a character of UTF-8 */
  }
  rosout_text(line, &path[from], MICROROS_LOG_ROSOUT_FILE);
}

static void rosout_begin(
  rosout_line_t * line, int severity, const char * name, rcutils_time_point_value_t timestamp)
{
  uint32_t nanoseconds;
  const uint64_t seconds = microros_format_seconds(timestamp, &nanoseconds);

  line->position = 0;
  rosout_number(line, (uint32_t)seconds);
  rosout_number(line, nanoseconds);
  line->body[line->position] = (uint8_t)severity;
  ++line->position;
  rosout_text(line, name, MICROROS_LOG_ROSOUT_NAME);
}

/* Puts file, function and line of the message. */
static void rosout_end(rosout_line_t * line, const rcutils_log_location_t * location)
{
  rosout_path(line, location == NULL ? "" : location->file_name);
  rosout_text(line, location == NULL ? "" : location->function_name, MICROROS_LOG_ROSOUT_FUNCTION);
  rosout_number(line, location == NULL ? 0u : (uint32_t)location->line_number);
}

static void rosout_report_dropped(rcutils_time_point_value_t timestamp)
{
  const microros_conversion_t number = {false, false, false, false, false, 0, -1, '\0', 'u'};
  rosout_line_t line;
  microros_format_t out;

  /* Reported once: there is room for a further line. */
  if (rosout_unreported == 0u || !xrce_rosout_has_room((uint32_t)sizeof(line.body))) {
    return;
  }
  rosout_begin(&line, RCUTILS_LOG_SEVERITY_WARN, "rcutils", timestamp);
  out = rosout_text_begin(&line, MICROROS_LOG_ROSOUT_TEXT);
  microros_format_integer(&out, &number, rosout_unreported, false);
  microros_format_string(&out, " messages dropped");
  rosout_text_end(&line, &out);
  rosout_end(&line, NULL);
  if (xrce_rosout_put(line.body, line.position)) {
    rosout_unreported = 0;
  }
}

/* Gives a line to those of both writers that take it: `is_published` for /rosout. Called with the lock. */
static void rosout_keep(const rosout_line_t * line, int severity, bool is_published)
{
  bool has_room;

  if (microros_ring_takes(severity)) {
    microros_ring_put(line->body, line->position);
  }
  has_room = !is_published || (rosout_unreported == 0u && xrce_rosout_put(line->body, line->position));
  if (!has_room) {
    microros_format_dropped();
    ++rosout_unreported;
  }
}

/* Encodes without the lock: arguments may be of any length, and take any time. */
static void rosout_log(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args, bool is_published)
{
  rosout_line_t line;
  microros_format_t out;

  rosout_begin(&line, severity, name, timestamp);
  out = rosout_text_begin(&line, MICROROS_LOG_ROSOUT_TEXT);
  microros_format_arguments(&out, format, args);
  rosout_text_end(&line, &out);
  rosout_end(&line, location);
  microros_lock();
  rosout_keep(&line, severity, is_published);
  microros_unlock();
}

/* With the lock: the text is short. */
static void rosout_log_text(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * text, bool is_published)
{
  rosout_line_t line;

  rosout_begin(&line, severity, name, timestamp);
  rosout_text(&line, text, MICROROS_LOG_ROSOUT_TEXT);
  rosout_end(&line, location);
  rosout_keep(&line, severity, is_published);
}

void rcl_logging_rosout_output_handler(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  microros_lock();
  rosout_report_dropped(timestamp);
  microros_unlock();
  rosout_log(location, severity, name == NULL ? "" : name, timestamp, format, args, true);
}

void microros_rosout_log(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  if (severity >= (int)MICROROS_LOG_ROSOUT_LEVEL) {
    rcl_logging_rosout_output_handler(location, severity, name, timestamp, format, args);
  } else if (microros_ring_takes(severity)) {
    rosout_log(location, severity, name, timestamp, format, args, false);
  } else {
    /* for neither */
  }
}

void microros_rosout_publish(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * text)
{
  rosout_log_text(location, severity, name, timestamp, text, true);
}

void microros_rosout_text(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * text)
{
  if (severity >= (int)MICROROS_LOG_ROSOUT_LEVEL) {
    microros_rosout_publish(location, severity, name, timestamp, text);
  } else if (microros_ring_takes(severity)) {
    rosout_log_text(location, severity, name, timestamp, text, false);
  } else {
    /* for neither */
  }
}

void microros_rosout_report(void)
{
  if (rosout_unreported != 0u) {
    rosout_report_dropped(microros_epoch_known_ns());
  }
}

void microros_rosout_step(const xrce_client_t * client)
{
  microros_rosout_report();
  xrce_rosout_send(client);
}
