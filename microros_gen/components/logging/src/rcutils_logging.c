/* SPDX-License-Identifier: Apache-2.0 */
#include "rcutils/logging.h"

#include "microros/epoch.h"
#include "microros/rcutils_console.h"
#include "microros/rcutils_library_log.h"
#include "microros/rcutils_rosout.h"
#include "microros_config.h"

bool g_rcutils_logging_initialized = true;

static rcutils_logging_output_handler_t logging_handler;

rcutils_ret_t rcutils_logging_initialize(void)
{
  if (!g_rcutils_logging_initialized) {
    (void)rcutils_logging_shutdown();
    g_rcutils_logging_initialized = true;
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_logging_initialize_with_allocator(rcutils_allocator_t allocator)
{
  (void)allocator; /* nothing is allocated */
  return rcutils_logging_initialize();
}

void rcutils_logging_set_output_handler(rcutils_logging_output_handler_t function)
{
  logging_handler = function;
}

rcutils_logging_output_handler_t rcutils_logging_get_output_handler(void)
{
  return logging_handler;
}

/* Both take from a copy: the next writer reads the same arguments. */
static void logging_publish(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  va_list copy;

  va_copy(copy, *args);
  microros_rosout_log(location, severity, name, timestamp, format, &copy);
  va_end(copy);
}

static void logging_call(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  va_list copy;

  va_copy(copy, *args);
  logging_handler(location, severity, name, timestamp, format, &copy);
  va_end(copy);
}

/* Without the writer `callback` its level is above all others, and a handler replaces the writers. */
static bool logging_replaces(void)
{
  return (int)MICROROS_LOG_CALLBACK_LEVEL > RCUTILS_LOG_SEVERITY_FATAL;
}

static bool logging_is_called(int severity)
{
  /* cppcheck-suppress knownConditionTrueFalse ; depends on the writers of the plan */
  return logging_handler != NULL && (logging_replaces() || severity >= (int)MICROROS_LOG_CALLBACK_LEVEL);
}

static bool logging_is_written(void)
{
  /* cppcheck-suppress knownConditionTrueFalse ; depends on the writers of the plan */
  return logging_handler == NULL || !logging_replaces();
}

static void logging_write(
  const rcutils_log_location_t * location, int severity, const char * name, const char * format,
  va_list * args)
{
  const rcutils_time_point_value_t timestamp = microros_epoch_known_ns();
  const char * const logger = name == NULL ? "" : name;

  if (logging_is_called(severity)) {
    logging_call(location, severity, logger, timestamp, format, args);
  }
  /* cppcheck-suppress knownConditionTrueFalse ; depends on the writers of the plan */
  if (logging_is_written()) {
    logging_publish(location, severity, logger, timestamp, format, args);
    microros_console_log(severity, logger, timestamp, format, args);
  }
}

/* As logging_call, with arguments. */
static void logging_call_with(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, ...)
{
  va_list args;

  va_start(args, format);
  logging_handler(location, severity, name, timestamp, format, &args);
  va_end(args);
}

void microros_log_text(
  const rcutils_log_location_t * location, int severity, const char * name, const char * text)
{
  const rcutils_time_point_value_t timestamp = microros_epoch_known_ns();

  if (logging_is_called(severity)) {
    logging_call_with(location, severity, name, timestamp, "%s", text);
  }
  /* cppcheck-suppress knownConditionTrueFalse ; depends on the writers of the plan */
  if (logging_is_written()) {
    microros_rosout_text(location, severity, name, timestamp, text);
    microros_console_text(severity, name, timestamp, text);
  }
}

void rcutils_log_internal(
  const rcutils_log_location_t * location, int severity, const char * name, const char * format, ...)
{
  va_list args;

  va_start(args, format);
  logging_write(location, severity, name, format, &args);
  va_end(args);
}

void rcutils_log(
  const rcutils_log_location_t * location, int severity, const char * name, const char * format, ...)
{
  va_list args;

  if (!rcutils_logging_logger_is_enabled_for(name, severity)) {
    return;
  }
  va_start(args, format);
  logging_write(location, severity, name, format, &args);
  va_end(args);
}
