/* SPDX-License-Identifier: Apache-2.0 */
/* Macros, levels and writers of log messages; MICROROS_LOG_LEVEL is DEBUG. */
#include "rcl/logging.h"
#include "rcutils/logging_macros.h"
#include "unit.h"

#include <poll.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

static int calls;
static int last_severity;
static char last_name[64];
static char last_text[128];
static size_t last_line;
static bool last_has_location;

static void handler(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  ++calls;
  last_severity = severity;
  (void)strncpy(last_name, name, sizeof(last_name) - 1u);
  (void)rcutils_logging_format(last_text, sizeof(last_text), format, args);
  last_has_location = location != NULL;
  last_line = location == NULL ? 0u : location->line_number;
  if (location != NULL) {
    CHECK(strstr(location->file_name, "unit_logging.c") != NULL);
    CHECK(strcmp(location->function_name, "locations") == 0 || location->line_number != 0u);
  }
  CHECK(timestamp > 1000000000000000000);
}

static int64_t now_ms;

static rcutils_ret_t clock_now(rcutils_time_point_value_t * now)
{
  *now = RCUTILS_MS_TO_NS(now_ms);
  return RCUTILS_RET_OK;
}

static rcutils_ret_t clock_broken(rcutils_time_point_value_t * now)
{
  (void)now;
  return RCUTILS_RET_ERROR;
}

static bool yes(void)
{
  return true;
}

static bool no(void)
{
  return false;
}

static int logged(void)
{
  const int count = calls;

  calls = 0;
  return count;
}

static void locations(void)
{
  RCUTILS_LOG_WARN_NAMED("arm.left", "%d of %s", 3, "four");
  CHECK(last_line == (size_t)__LINE__ - 1u);
  CHECK(last_has_location && last_severity == RCUTILS_LOG_SEVERITY_WARN);
  CHECK(strcmp(last_name, "arm.left") == 0 && strcmp(last_text, "3 of four") == 0);
  RCUTILS_LOG_FATAL("plain");
  CHECK(last_severity == RCUTILS_LOG_SEVERITY_FATAL && strcmp(last_name, "") == 0);
  rcutils_log(NULL, RCUTILS_LOG_SEVERITY_INFO, NULL, "%s", "without");
  CHECK(!last_has_location && strcmp(last_text, "without") == 0);
  CHECK(logged() == 3);
}

static void conditions(void)
{
  for (int i = 0; i < 5; ++i) {
    RCUTILS_LOG_INFO_ONCE("once");
    RCUTILS_LOG_INFO_ONCE_NAMED("n", "once %d", i);
  }
  CHECK(logged() == 2);
  for (int i = 0; i < 5; ++i) {
    RCUTILS_LOG_ERROR_EXPRESSION(i % 2 == 0, "even %d", i);
    RCUTILS_LOG_ERROR_EXPRESSION_NAMED(i == 4, "n", "four");
  }
  CHECK(logged() == 4);
  RCUTILS_LOG_DEBUG_FUNCTION(yes, "yes");
  RCUTILS_LOG_DEBUG_FUNCTION(&no, "no");
  RCUTILS_LOG_DEBUG_FUNCTION_NAMED(yes, "n", "yes");
  CHECK(logged() == 2);
  for (int i = 0; i < 5; ++i) {
    RCUTILS_LOG_WARN_SKIPFIRST("%d", i);
    RCUTILS_LOG_WARN_SKIPFIRST_NAMED("n", "%d", i);
  }
  CHECK(logged() == 8);
}

static void throttled(void)
{
  for (now_ms = 1000; now_ms < 2000; now_ms += 10) {
    RCUTILS_LOG_INFO_THROTTLE(clock_now, 100, "%d", (int)now_ms);
  }
  CHECK(logged() == 10);
  for (now_ms = 1000; now_ms < 2000; now_ms += 10) {
    RCUTILS_LOG_INFO_SKIPFIRST_THROTTLE(clock_now, 100, "x");
  }
  CHECK(logged() == 9);
  for (now_ms = 1000; now_ms < 2000; now_ms += 10) {
    RCUTILS_LOG_INFO_THROTTLE_NAMED(clock_now, 250, "n", "x");
  }
  CHECK(logged() == 4);
  RCUTILS_LOG_INFO_SKIPFIRST_THROTTLE_NAMED(clock_broken, 100, "n", "x");
  CHECK(logged() == 0);
  RCUTILS_LOG_INFO_THROTTLE(clock_broken, 100, "the time is not known");
  CHECK(logged() == 1);
}

/* A clock that begins with the device: the first message is logged at once. */
static void throttled_from_zero(void)
{
  for (now_ms = 0; now_ms < 1000; now_ms += 10) {
    RCUTILS_LOG_INFO_THROTTLE(clock_now, 100, "x");
  }
  CHECK(logged() == 10);
}

/* A clock that is set back, as the time of day can be: messages go on at the usual distance from there. */
static void throttled_over_a_step_back(void)
{
  static const int64_t starts[] = {INT64_C(4294967296), INT64_C(2147483648), 0, -500};

  for (size_t i = 0; i < sizeof(starts) / sizeof(starts[0]); ++i) {
    for (now_ms = starts[i]; now_ms < starts[i] + 1000; now_ms += 10) {
      RCUTILS_LOG_INFO_THROTTLE(clock_now, 100, "x");
    }
    CHECK(logged() == 10);
  }
}

/* From before until after a count of milliseconds has 31 and 32 bits; a forward step is one message. */
static void throttled_over_large_times(void)
{
  static const int64_t ends[] = {INT64_C(1) << 31, INT64_C(1) << 32, INT64_C(1700000000000)};

  for (size_t i = 0; i < sizeof(ends) / sizeof(ends[0]); ++i) {
    for (now_ms = ends[i] - 500; now_ms < ends[i] + 500; now_ms += 10) {
      RCUTILS_LOG_INFO_THROTTLE(clock_now, 100, "x");
    }
    CHECK(logged() == 10);
  }
  now_ms = 2 * INT64_C(1700000000000);
  for (int i = 0; i < 3; ++i) {
    RCUTILS_LOG_INFO_THROTTLE(clock_now, INT64_C(4294967297), "once in 49.7 days");
    now_ms += INT64_C(4294967296);
  }
  CHECK(logged() == 2);
  for (int i = 0; i < 3; ++i) {
    RCUTILS_LOG_INFO_THROTTLE(clock_now, 0, "always");
    RCUTILS_LOG_INFO_THROTTLE(clock_now, -1, "always");
  }
  CHECK(logged() == 6);
}

static int64_t read_clock(clockid_t clock)
{
  struct timespec now;

  CHECK(clock_gettime(clock, &now) == 0);
  return RCUTILS_S_TO_NS((int64_t)now.tv_sec) + now.tv_nsec;
}

static void throttled_by_the_steady_clock(void)
{
  int64_t now = 0;
  int64_t begin = read_clock(CLOCK_MONOTONIC);

  CHECK(rcutils_steady_time_now(&now) == RCUTILS_RET_OK);
  CHECK(begin <= now && now <= read_clock(CLOCK_MONOTONIC));
  CHECK(rcutils_steady_time_now(NULL) == RCUTILS_RET_INVALID_ARGUMENT);
  begin = read_clock(CLOCK_REALTIME);
  CHECK(rcutils_system_time_now(&now) == RCUTILS_RET_OK);
  CHECK(begin <= now && now <= read_clock(CLOCK_REALTIME));
  CHECK(rcutils_system_time_now(NULL) == RCUTILS_RET_INVALID_ARGUMENT);
  for (int i = 0; i < 100; ++i) {
    RCUTILS_LOG_WARN_THROTTLE(RCUTILS_STEADY_TIME, 3600000, "temperature %d", i);
  }
  CHECK(logged() == 1);
  begin = read_clock(CLOCK_MONOTONIC);
  while (calls < 2) {
    RCUTILS_LOG_WARN_THROTTLE(RCUTILS_STEADY_TIME, 10, "temperature");
  }
  CHECK(read_clock(CLOCK_MONOTONIC) - begin >= RCUTILS_MS_TO_NS(10));
  (void)logged();
}

static int evaluated;

static int evaluate(void)
{
  ++evaluated;
  return evaluated;
}

/* Each macro is one statement, and evaluates what it is given at most once. */
static void nested(void)
{
  for (int i = 0; i < 4; ++i) {
    if (i % 2 == 0)
      if (i == 2)
        RCUTILS_LOG_INFO_EXPRESSION(evaluate() > 0, "%d", evaluate());
      else
        RCUTILS_LOG_INFO_THROTTLE_NAMED(clock_now, 0, "n", "%d", evaluate());
    else
      RCUTILS_LOG_INFO_SKIPFIRST("%d", evaluate());
  }
  CHECK(logged() == 3 && evaluated == 4);
  rcutils_logging_set_default_logger_level(RCUTILS_LOG_SEVERITY_FATAL);
  RCUTILS_LOG_ERROR_EXPRESSION(evaluate() > 0, "%d", evaluate());
  RCUTILS_LOG_ERROR_ONCE("%d", evaluate());
  CHECK(logged() == 0 && evaluated == 4);
  rcutils_logging_set_default_logger_level(RCUTILS_LOG_SEVERITY_UNSET);
  evaluated = 0;
}

static void levels(void)
{
  CHECK(rcutils_logging_get_default_logger_level() == RCUTILS_LOG_SEVERITY_DEBUG);
  CHECK(rcutils_logging_get_logger_level("arm") == RCUTILS_LOG_SEVERITY_UNSET);
  CHECK(
    rcutils_logging_get_logger_level(NULL) == -1 && rcutils_logging_get_logger_effective_level(NULL) == -1);
  CHECK(rcutils_logging_set_logger_level("arm", RCUTILS_LOG_SEVERITY_ERROR) == RCUTILS_RET_OK);
  RCUTILS_LOG_WARN_NAMED("arm.left", "%d", evaluate());
  RCUTILS_LOG_WARN_NAMED("armed", "%d", evaluate());
  CHECK(logged() == 1 && evaluated == 1);
  CHECK(rcutils_logging_set_logger_level("arm.left", RCUTILS_LOG_SEVERITY_DEBUG) == RCUTILS_RET_OK);
  CHECK(rcutils_logging_get_logger_effective_level("arm.left.hand") == RCUTILS_LOG_SEVERITY_DEBUG);
  CHECK(rcutils_logging_get_logger_effective_level("arm.right") == RCUTILS_LOG_SEVERITY_ERROR);
  CHECK(rcutils_logging_get_logger_leveln("arm.left", 3) == RCUTILS_LOG_SEVERITY_ERROR);
  CHECK(rcutils_logging_logger_is_enabled_for(NULL, RCUTILS_LOG_SEVERITY_DEBUG));
  CHECK(rcutils_logging_set_logger_level("arm", 35) == RCUTILS_RET_INVALID_ARGUMENT);
  CHECK(rcutils_logging_set_logger_level(NULL, 30) == RCUTILS_RET_INVALID_ARGUMENT);
  CHECK(
    rcutils_logging_set_logger_level("a name of more than thirty-one letters", 30) ==
    RCUTILS_RET_NOT_ENOUGH_SPACE);
  CHECK(strstr(rcutils_get_error_string().str, "a name of more") != NULL);
  CHECK(rcutils_logging_set_logger_level("c", 30) == RCUTILS_RET_OK);
  CHECK(rcutils_logging_set_logger_level("d", 30) == RCUTILS_RET_OK);
  CHECK(rcutils_logging_set_logger_level("e", 30) == RCUTILS_RET_ERROR);
  CHECK(strstr(rcutils_get_error_string().str, "4 loggers") != NULL);
  CHECK(rcutils_logging_set_logger_level("arm", RCUTILS_LOG_SEVERITY_UNSET) == RCUTILS_RET_OK);
  CHECK(rcutils_logging_get_logger_effective_level("arm.right") == RCUTILS_LOG_SEVERITY_DEBUG);
  CHECK(rcutils_logging_set_logger_level("e", 30) == RCUTILS_RET_OK);
  CHECK(rcutils_logging_set_logger_level("", RCUTILS_LOG_SEVERITY_FATAL) == RCUTILS_RET_OK);
  RCUTILS_LOG_ERROR("no");
  CHECK(logged() == 0);
  rcutils_logging_set_default_logger_level(RCUTILS_LOG_SEVERITY_UNSET);
  CHECK(rcutils_logging_get_default_logger_level() == RCUTILS_LOG_SEVERITY_DEBUG);
}

static void names(void)
{
  int level = 0;

  CHECK(
    rcutils_logging_severity_level_from_string("wArN", rcutils_get_default_allocator(), &level) ==
    RCUTILS_RET_OK);
  CHECK(level == RCUTILS_LOG_SEVERITY_WARN);
  CHECK(
    rcutils_logging_severity_level_from_string("loud", rcutils_get_default_allocator(), &level) ==
    RCUTILS_RET_LOGGING_SEVERITY_STRING_INVALID);
  CHECK(strcmp(g_rcutils_log_severity_names[RCUTILS_LOG_SEVERITY_FATAL], "FATAL") == 0);
  CHECK(g_rcutils_log_severity_names[15] == NULL);
}

/* Reads the error output into `text`. */
static void written(int end, char * text, size_t size)
{
  struct pollfd ready = {end, POLLIN, 0};
  size_t used = 0;

  while (used + 1u < size && poll(&ready, 1, 0) == 1) {
    const ssize_t got = read(end, &text[used], size - 1u - used);

    CHECK(got > 0);
    used += (size_t)got;
  }
  text[used] = '\0';
}

/* A handler of the application that passes messages on to the writers. */
static void passing(
  const rcutils_log_location_t * location, int severity, const char * name,
  rcutils_time_point_value_t timestamp, const char * format, va_list * args)
{
  ++calls;
  rcl_logging_multiple_output_handler(
    location, severity, strcmp(name, "arm") == 0 ? NULL : name, timestamp, format, args);
}

static void passed_on(int end)
{
  char text[512];

  rcutils_logging_set_output_handler(passing);
  RCUTILS_LOG_INFO_NAMED("arm", "%d of %s", 3, "four");
  RCUTILS_LOG_WARN_NAMED("leg", "%d of %s", 5, "six");
  rcutils_logging_set_output_handler(NULL);
  written(end, text, sizeof(text));
  CHECK(
    logged() == 2 && strstr(text, "] []: 3 of four\n") != NULL &&
    strstr(text, "] [leg]: 5 of six\n") != NULL);
}

enum { LINES = 4 };
static char lines[LINES][300000];

/* Logs with nobody reading until five messages are dropped; puts in `lines` what was read at each step. */
static void console(int end)
{
  rcutils_logging_set_output_handler(NULL);
  RCUTILS_LOG_INFO_NAMED("arm", "turns: %u", 7u);
  written(end, lines[0], sizeof(lines[0]));
  RCUTILS_LOG_DEBUG("%300d", 1);
  written(end, lines[1], sizeof(lines[1]));
  while (rcutils_logging_get_counts().dropped < 5u) {
    RCUTILS_LOG_WARN("nobody reads this");
  }
  written(end, lines[2], sizeof(lines[2]));
  RCUTILS_LOG_WARN("read again");
  RCUTILS_LOG_WARN("and again");
  written(end, lines[3], sizeof(lines[3]));
}

static void console_lines(void)
{
  const size_t size = strlen(lines[1]);
  const char * dropped = NULL;

  CHECK(strncmp(lines[0], "[INFO] [", 8) == 0 && lines[0][18] == '.');
  CHECK(strcmp(&lines[0][28], "] [arm]: turns: 7\n") == 0);
  CHECK(size == MICROROS_LOG_TEXT_SIZE && strcmp(&lines[1][size - 4u], "...\n") == 0);
  CHECK(strstr(lines[2], "nobody reads this\n") != NULL && strstr(lines[2], "dropped") == NULL);
  dropped = strstr(lines[3], "[rcutils]: 5 messages dropped\n");
  CHECK(dropped != NULL && strstr(dropped, "read again\n") != NULL && strstr(dropped, "and again\n") != NULL);
  CHECK(strstr(strstr(dropped, "\n"), "dropped") == NULL);
}

/* The image has no memory for a text that does not fit into the buffer of the handler. */
static void messages_without_memory(void)
{
  char text[40] = "";
  rcutils_char_array_t out = rcutils_get_zero_initialized_char_array();

  out.allocator = rcutils_get_default_allocator();
  out.owns_buffer = false;
  out.buffer = text;
  out.buffer_capacity = sizeof(text);
  CHECK(rcutils_logging_format_message(NULL, 20, "a", 0, "0123", &out) == RCUTILS_RET_OK);
  CHECK(strcmp(out.buffer, "[INFO] [0000000000.000000000] [a]: 0123") == 0 && out.buffer == text);
  CHECK(rcutils_logging_format_message(NULL, 20, "a", 0, "", &out) == RCUTILS_RET_BAD_ALLOC);
  CHECK(rcutils_char_array_strcat(&out, "4") == RCUTILS_RET_BAD_ALLOC);
  CHECK(strlen(text) == sizeof(text) - 1u && out.buffer == text);
  CHECK(rcutils_char_array_strncat(&out, "", 9) == RCUTILS_RET_OK);
  CHECK(rcutils_logging_format_message(NULL, 20, "a", 0, NULL, &out) == RCUTILS_RET_INVALID_ARGUMENT);
  rcutils_reset_error();
}

static void configured(void)
{
  const rcl_arguments_t arguments = rcl_get_zero_initialized_arguments();
  const rcl_allocator_t allocator = rcl_get_default_allocator();

  CHECK(rcl_logging_configure(NULL, &allocator) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_logging_configure_with_output_handler(&arguments, &allocator, handler) == RCL_RET_OK);
  CHECK(rcutils_logging_get_output_handler() == handler);
  CHECK(rcl_logging_fini() == RCL_RET_OK);
  CHECK(rcutils_logging_get_output_handler() == NULL && !g_rcutils_logging_initialized);
  CHECK(rcutils_logging_initialize() == RCUTILS_RET_OK && g_rcutils_logging_initialized);
  CHECK(!rcl_logging_rosout_enabled());
}

int main(void)
{
  int ends[2];
  const int error_output = dup(STDERR_FILENO);

  CHECK(error_output >= 0 && socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
  rcutils_logging_set_output_handler(handler);
  locations();
  conditions();
  throttled();
  throttled_from_zero();
  throttled_over_a_step_back();
  throttled_over_large_times();
  throttled_by_the_steady_clock();
  nested();
  levels();
  names();
  messages_without_memory();
  configured();
  CHECK(dup2(ends[1], STDERR_FILENO) >= 0);
  passed_on(ends[0]);
  console(ends[0]);
  CHECK(dup2(error_output, STDERR_FILENO) >= 0);
  console_lines();
  return 0;
}
