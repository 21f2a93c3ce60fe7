/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The macros of log messages where the component `logging` is not selected: they compile to nothing. The compiler checks
 * format, arguments and conditions; none of them is evaluated.
 */
#ifndef MICROROS_RCUTILS_LOGGING_MACROS_H
#define MICROROS_RCUTILS_LOGGING_MACROS_H

#include <stdbool.h>
#include <stddef.h>

#include "rcutils/macros.h"
#include "rcutils/time.h"
#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __cplusplus
#define RCUTILS_CAST_DURATION(x) \
  (static_cast<rcutils_duration_value_t>(x)) /* as C++ asks with -Wold-style-cast */
#else
#define RCUTILS_CAST_DURATION(x) ((rcutils_duration_value_t)(x))
#endif

/* Never called. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static inline void
microros_log_nothing(const char * name, const char * format, ...)
{
  (void)name;
  (void)format;
}

/* What only the condition uses is no unused variable or function. */
#define MICROROS_LOG_NOTHING(condition, name, ...) \
  do { \
    if (false) { \
      rcutils_time_point_value_t microros_log_now = 0; \
      (void)microros_log_now; \
      if (condition) { \
        microros_log_nothing(name, __VA_ARGS__); \
      } \
    } \
  } while (0)

#define MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration) \
  (get_time_point_value(&microros_log_now) == RCUTILS_RET_OK && RCUTILS_CAST_DURATION(duration) > 0)

#define RCUTILS_LOG_DEBUG(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_ONCE(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_ONCE_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_EXPRESSION(expression, ...) MICROROS_LOG_NOTHING(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_EXPRESSION_NAMED(expression, name, ...) \
  MICROROS_LOG_NOTHING(expression, name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_FUNCTION(function, ...) MICROROS_LOG_NOTHING((*(function))(), NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_FUNCTION_NAMED(function, name, ...) \
  MICROROS_LOG_NOTHING((*(function))(), name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)

#define RCUTILS_LOG_INFO(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_ONCE(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_ONCE_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_EXPRESSION(expression, ...) MICROROS_LOG_NOTHING(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_EXPRESSION_NAMED(expression, name, ...) \
  MICROROS_LOG_NOTHING(expression, name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_FUNCTION(function, ...) MICROROS_LOG_NOTHING((*(function))(), NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_FUNCTION_NAMED(function, name, ...) \
  MICROROS_LOG_NOTHING((*(function))(), name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_INFO_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)

#define RCUTILS_LOG_WARN(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_ONCE(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_ONCE_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_EXPRESSION(expression, ...) MICROROS_LOG_NOTHING(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_EXPRESSION_NAMED(expression, name, ...) \
  MICROROS_LOG_NOTHING(expression, name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_FUNCTION(function, ...) MICROROS_LOG_NOTHING((*(function))(), NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_FUNCTION_NAMED(function, name, ...) \
  MICROROS_LOG_NOTHING((*(function))(), name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_WARN_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)

#define RCUTILS_LOG_ERROR(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_ONCE(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_ONCE_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_EXPRESSION(expression, ...) MICROROS_LOG_NOTHING(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_EXPRESSION_NAMED(expression, name, ...) \
  MICROROS_LOG_NOTHING(expression, name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_FUNCTION(function, ...) MICROROS_LOG_NOTHING((*(function))(), NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_FUNCTION_NAMED(function, name, ...) \
  MICROROS_LOG_NOTHING((*(function))(), name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)

#define RCUTILS_LOG_FATAL(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_ONCE(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_ONCE_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_EXPRESSION(expression, ...) MICROROS_LOG_NOTHING(expression, NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_EXPRESSION_NAMED(expression, name, ...) \
  MICROROS_LOG_NOTHING(expression, name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_FUNCTION(function, ...) MICROROS_LOG_NOTHING((*(function))(), NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_FUNCTION_NAMED(function, name, ...) \
  MICROROS_LOG_NOTHING((*(function))(), name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST(...) MICROROS_LOG_NOTHING(true, NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST_NAMED(name, ...) MICROROS_LOG_NOTHING(true, name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST_THROTTLE(get_time_point_value, duration, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), NULL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST_THROTTLE_NAMED(get_time_point_value, duration, name, ...) \
  MICROROS_LOG_NOTHING(MICROROS_LOG_CHECK_THROTTLE(get_time_point_value, duration), name, __VA_ARGS__)
#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_LOGGING_MACROS_H */
