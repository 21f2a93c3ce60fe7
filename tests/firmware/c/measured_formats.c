/* SPDX-License-Identifier: Apache-2.0 */
/* Formats texts of the worst kinds, each between two marks: as a line of the log, and as the text of an error. */
#include "measured.h"

#include <microros/error.h>
#include <rcl/error_handling.h>
#include <rclc/rclc.h>
#include <rcutils/logging.h>
#include <stdarg.h>
#include <string.h>

enum { LINE = 192, LONG = 6000, FORMAT = 600 };

static volatile bool is_running;
static char line[LINE];
static char text[LONG];
static char format[FORMAT];

__attribute__((noinline)) static void formatted(const char * with, ...)
{
  va_list args;

  va_start(args, with);
  mark();
  (void)rcutils_logging_format(line, sizeof(line), with, &args);
  mark();
  va_end(args);
}

/* Repeats a conversion as often as the format has room for. */
static const char * repeated(const char * conversion)
{
  const size_t size = strlen(conversion);
  size_t used = 0;

  for (; used + size < (size_t)FORMAT; used += size) {
    (void)memcpy(&format[used], conversion, size);
  }
  format[used] = '\0';
  return format;
}

#define FOUR(argument) argument, argument, argument, argument
#define SIXTEEN(argument) FOUR(FOUR(argument))
#define MANY(argument) FOUR(SIXTEEN(argument)) /* as many arguments as a conversion of one character can use up */

static void lines_measure(void)
{
  formatted(repeated("x"));
  formatted("%s", text);
  formatted("%4095s", text);
  formatted("%4095.3s|", text);
  formatted("%-4095s", text);
  formatted(repeated("%s"), MANY(""), MANY(""), MANY(""), MANY(""));
  formatted(repeated("%s"), MANY("ab"), MANY("ab"), MANY("ab"), MANY("ab"));
  formatted(repeated("%.1s"), MANY(text), MANY(text), MANY(text), MANY(text));
  formatted(repeated("%d"), MANY(7), MANY(7), MANY(7), MANY(7));
  formatted(repeated("%i"), MANY(INT32_MIN), MANY(INT32_MIN));
  formatted(repeated("%-+ #00000000001d"), MANY(1), MANY(1));
  formatted(repeated("%.0d"), MANY(0), MANY(0), MANY(0), MANY(0));
  formatted("%llo%llo%llo%llo%llo%llo%llo%llo%llo", FOUR(UINT64_MAX), FOUR(UINT64_MAX), UINT64_MAX);
  formatted("%0000000000000000000000000000000005d", 1);
  formatted("%00000000005d %.99999999999999999999d", 1, 2);
  formatted(repeated("%c"), MANY('c'), MANY('c'), MANY('c'), MANY('c'));
  formatted("%2000000000d", 1);
  formatted("%q and more %s", "x");
}

static void error_measure(const char * template, const char * name, const char * detail, uint32_t number)
{
  mark();
  microros_error_set(template, name, detail, number, number);
  mark();
}

static void errors_measure(void)
{
  const char * const type = "visualization_msgs::msg::dds_::InteractiveMarkerControl_";

  error_measure("%s", text, "", 0);
  error_measure("%d %s", text, "", 0);
  error_measure("%t %D", text, text, 0);
  error_measure("%t%t%t%t%D%D%D%D", type, type, 0);
  error_measure("%n%m%n%m%n%m%a%a", "", "", UINT32_MAX);
  error_measure("%t%D%t%D%n%m%n%a", "a::b::c_", "a::b::cccccccccccccccccccccccccccccccccccccccc", UINT32_MAX);
  error_measure(repeated("y"), "", "", 0);
  mark();
  rcutils_set_error_state(text, "file", 1);
  mark();
}

int main(void)
{
  if (is_running) { /* the tool compares the plan of an image with that of its library */
    rcl_allocator_t allocator = rcl_get_default_allocator();
    rclc_support_t support;

    (void)rclc_support_init(&support, 0, NULL, &allocator);
  }
  (void)memset(text, 'x', sizeof(text) - 1u);
  lines_measure();
  errors_measure();
  finish();
  return 0;
}
