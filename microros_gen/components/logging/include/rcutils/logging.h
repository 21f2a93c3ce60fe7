/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Log messages, their levels and where they go. A message has a level, the name of its logger, a time (nanoseconds
 * since 1970) and a text. It goes to the writers that `logging:` of the application file lists, each with a separate
 * level. Loggers form a tree: a name without a level has that of the name before its last dot, and finally the
 * default level. Nothing here takes memory from a heap; a text longer than MICROROS_LOG_TEXT_SIZE ends with `...`.
 *
 * Formats: %d %i %u %x %X %o %c %s %p %%, with flags, width, precision and the lengths hh h l ll z j t; with the
 * component `logging_float` also %f %F %e %E %g %G, and with `logging_wide` %ls and %lc, as UTF-8. Other floating-point
 * conversions are printed unchanged. So is any other conversion with all that follows it: its argument is unknown.
 *
 * With the component `multithread` every task may call these functions; the output handler is set before other tasks
 * log, and several tasks may be in it at once. Not for interrupts: set a flag there, and log in a task.
 */
#ifndef MICROROS_RCUTILS_LOGGING_H
#define MICROROS_RCUTILS_LOGGING_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rcutils/error_handling.h"
#include "rcutils/macros.h"
#include "rcutils/time.h"
#include "rcutils/types/char_array.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define RCUTILS_ATTRIBUTE_PRINTF_FORMAT(format_index, first) \
  __attribute__((format(printf, format_index, first)))
#else
#define RCUTILS_ATTRIBUTE_PRINTF_FORMAT(format_index, first)
#endif

#define RCUTILS_LOGGING_SEPARATOR_CHAR '.'
#define RCUTILS_LOGGING_SEPARATOR_STRING "."

/* The lowest level of the writers, INFO where none is given. */
#define RCUTILS_DEFAULT_LOGGER_DEFAULT_LEVEL ((int)MICROROS_LOG_LEVEL)

enum RCUTILS_LOG_SEVERITY {
  RCUTILS_LOG_SEVERITY_UNSET = 0,
  RCUTILS_LOG_SEVERITY_DEBUG = 10,
  RCUTILS_LOG_SEVERITY_INFO = 20,
  RCUTILS_LOG_SEVERITY_WARN = 30,
  RCUTILS_LOG_SEVERITY_ERROR = 40,
  RCUTILS_LOG_SEVERITY_FATAL = 50
};

/* Where a message is logged. */
typedef struct rcutils_log_location_s {
  const char * function_name;
  const char * file_name;
  size_t line_number;
} rcutils_log_location_t;

/*
 * Receives each message that its logger is enabled for. `location` can be NULL, `name` is "" without a logger. The
 * strings are valid during the call. */
typedef void (*rcutils_logging_output_handler_t)(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args);

/* Logging needs no initialization. Both functions restore the levels of the build and remove the output handler, the
 * first one only after rcutils_logging_shutdown. */
rcutils_ret_t rcutils_logging_initialize(void);
rcutils_ret_t rcutils_logging_initialize_with_allocator(rcutils_allocator_t allocator);
rcutils_ret_t rcutils_logging_shutdown(void);

extern bool g_rcutils_logging_initialized;

#define RCUTILS_LOGGING_AUTOINIT (void)0
#define RCUTILS_LOGGING_AUTOINIT_WITH_ALLOCATOR(alloc) (void)(alloc)

/* "DEBUG" at 10, "INFO" at 20 …; NULL between them. */
extern const char * const g_rcutils_log_severity_names[RCUTILS_LOG_SEVERITY_FATAL + 1];

/* Case does not matter. RCUTILS_RET_LOGGING_SEVERITY_STRING_INVALID for a word that names no level. */
#define RCUTILS_RET_LOGGING_SEVERITY_MAP_INVALID 40
#define RCUTILS_RET_LOGGING_SEVERITY_STRING_INVALID 41
rcutils_ret_t rcutils_logging_severity_level_from_string(
  const char * severity_string, rcutils_allocator_t allocator, int * severity);

/*
 * Sets the function that gets all messages instead of the writers; with `callback` among them, it takes the place of
 * that one alone. NULL removes it. */
void rcutils_logging_set_output_handler(rcutils_logging_output_handler_t function);

/* Returns the function, NULL without one. */
rcutils_logging_output_handler_t rcutils_logging_get_output_handler(void);

/* The level of loggers without one. UNSET restores the level of the build. */
int rcutils_logging_get_default_logger_level(void);
void rcutils_logging_set_default_logger_level(int level);

/* Returns the level that was set for exactly this name, UNSET without one, -1 for NULL. "" is the default level. */
int rcutils_logging_get_logger_level(const char * name);
int rcutils_logging_get_logger_leveln(const char * name, size_t name_length);

/*
 * Sets the level of a logger and of those below it; UNSET removes it. The name is copied.
 * RCUTILS_RET_INVALID_ARGUMENT for NULL or an invalid level, RCUTILS_RET_NOT_ENOUGH_SPACE for a name of
 * MICROROS_LOGGER_NAME_SIZE characters or more, RCUTILS_RET_ERROR when MICROROS_LOGGERS_MAX loggers have a level.
 */
rcutils_ret_t rcutils_logging_set_logger_level(const char * name, int level);

/* Returns the level that holds for a logger; -1 for NULL. */
int rcutils_logging_get_logger_effective_level(const char * name);

/* Returns whether a message is logged. NULL: without a logger. */
bool rcutils_logging_logger_is_enabled_for(const char * name, int severity);

/*
 * Logs a message if its logger is enabled for the level (rcutils_log_internal does not check). `location` and `name`
 * can be NULL.
 */
void rcutils_log(
  const rcutils_log_location_t * location, int severity, const char * name, const char * format, ...)
  RCUTILS_ATTRIBUTE_PRINTF_FORMAT(4, 5);
void rcutils_log_internal(
  const rcutils_log_location_t * location, int severity, const char * name, const char * format, ...)
  RCUTILS_ATTRIBUTE_PRINTF_FORMAT(4, 5);

/*
 * Writes the text of a message and a NUL, at most `size` characters; returns its length. For output handlers, instead of
 * the C library's vsnprintf. A text that is cut off ends with `...`. Returns 0 for NULL or size 0. */
size_t rcutils_logging_format(char * text, size_t size, const char * format, va_list * args);

/*
 * Appends `[INFO] [1700000000.123456789] [name]: msg`, ROS 2's default format, to `logging_output`. For output handlers,
 * after rcutils_char_array_vsprintf. `location` is not used; `name` can be NULL. RCUTILS_RET_BAD_ALLOC if the text does
 * not fit and the allocator has no memory. */
rcutils_ret_t rcutils_logging_format_message(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * msg, rcutils_char_array_t * logging_output);

/* Writes a message to the console; with the component `logging_console` (`logging: console`). */
void rcutils_logging_console_output_handler(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args);

/* Number of truncated texts and of messages that a writer dropped, since the start. */
typedef struct rcutils_logging_counts_t {
  uint32_t truncated;
  uint32_t dropped;
} rcutils_logging_counts_t;

rcutils_logging_counts_t rcutils_logging_get_counts(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_LOGGING_H */
