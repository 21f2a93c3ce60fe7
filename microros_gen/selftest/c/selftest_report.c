/* SPDX-License-Identifier: Apache-2.0 */
#include "selftest_report.h"

#include "microros/port.h"
#include "selftest.h"

#include <stddef.h>

enum { LINE = 120, DIGITS = 21, TEN = 10, TRIES = 3 };

static struct {
  char text[LINE];
  size_t size;
  uint32_t passed;
  uint32_t failed;
} report;

/* Cuts off what is beyond the end of the line. */
static void put_text(const char * text)
{
  for (size_t i = 0; text[i] != '\0' && report.size + 1u < sizeof(report.text); ++i) {
    report.text[report.size] = text[i];
    ++report.size;
  }
  report.text[report.size] = '\0';
}

static void put_number(int64_t value)
{
  char digits[DIGITS + 1];
  size_t first = DIGITS;
  uint64_t left = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;

  digits[DIGITS] = '\0';
  do {
    --first;
    digits[first] = (char)('0' + (char)(left % (uint64_t)TEN));
    left /= (uint64_t)TEN;
  } while (left != 0u);
  if (value < 0) {
    --first;
    digits[first] = '-';
  }
  put_text(&digits[first]);
}

static void put_end(void)
{
  selftest_line(report.text);
  report.size = 0;
}

static void pass(const char * name)
{
  ++report.passed;
  put_text("PASS ");
  put_text(name);
  put_end();
}

static void fail_begin(const char * name)
{
  ++report.failed;
  put_text("FAIL ");
  put_text(name);
  put_text(": seen ");
}

static void check(
  const char * name, int64_t seen, bool is_right, const char * relation, int64_t expected, const char * unit)
{
  if (is_right) {
    pass(name);
    return;
  }
  fail_begin(name);
  put_number(seen);
  put_text(" expected ");
  put_text(relation);
  put_number(expected);
  put_text(" ");
  put_text(unit);
  put_end();
}

void selftest_equal(const char * name, int64_t seen, int64_t expected, const char * unit)
{
  check(name, seen, seen == expected, "", expected, unit);
}

void selftest_at_least(const char * name, int64_t seen, int64_t least, const char * unit)
{
  check(name, seen, seen >= least, "at least ", least, unit);
}

void selftest_at_most(const char * name, int64_t seen, int64_t most, const char * unit)
{
  check(name, seen, seen <= most, "at most ", most, unit);
}

void selftest_true(const char * name, bool is_right, const char * seen, const char * expected)
{
  if (is_right) {
    pass(name);
    return;
  }
  fail_begin(name);
  put_text(seen);
  put_text(" expected ");
  put_text(expected);
  put_end();
}

void selftest_skip(const char * name, const char * why)
{
  put_text("SKIP ");
  put_text(name);
  put_text(": ");
  put_text(why);
  put_end();
}

uint32_t selftest_end(void)
{
  const uint32_t failed = report.failed;
  const uint32_t all = report.passed + failed;

  put_text(failed == 0u ? "PASS " : "FAIL ");
  put_number(failed == 0u ? (int64_t)all : (int64_t)failed);
  put_text(" of ");
  put_number((int64_t)all);
  put_end();
  report.passed = 0;
  report.failed = 0;
  return failed;
}

uint32_t selftest_shortest_ms(void (*call)(void))
{
  uint32_t shortest = UINT32_MAX;

  for (int i = 0; i < (int)TRIES; ++i) {
    const uint32_t start = port_time_ms();
    uint32_t passed;

    call();
    passed = port_time_ms() - start;
    shortest = passed < shortest ? passed : shortest;
  }
  return shortest;
}
