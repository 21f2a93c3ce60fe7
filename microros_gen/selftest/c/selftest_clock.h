/* SPDX-License-Identifier: Apache-2.0 */
/* What holds for every clock of a port. */
#ifndef SELFTEST_CLOCK_H
#define SELFTEST_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

/* A clock in its own unit, and the names of its checks. `unit_ms`: units in a millisecond. A clock that wraps has `wraps_at`
 * (0: it does not): the difference of two times is taken modulo that. */
typedef struct selftest_clock_t {
  uint64_t (*now)(void);
  uint64_t wraps_at;
  uint32_t unit_ms;
  const char * backwards;
  const char * resolution;
  const char * agrees;
} selftest_clock_t;

/* Reads the clock again and again until 25 ms have passed: it never goes back, and its smallest step is 10 ms at most. A
 * clock that stands still ends the loop, too: the result is whether it advances. */
bool selftest_clock(const selftest_clock_t * clock);

/* Compares the clock with port_time_ms over 50 ms; port_sleep_ms of the port is needed. */
void selftest_clock_agrees(const selftest_clock_t * clock);

#endif /* SELFTEST_CLOCK_H */
