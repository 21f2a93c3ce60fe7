/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_report.h"

enum {
  NO_HANDLE = -1,
  LONG_MS = 500,
  KEPT_MS = 250,
  SHORT_MS = 10,
  MORE_MS = 20,
  ZERO_MS = 10,
  REST_MS = 40
};

/* A wait may end at any interrupt; a board has a few per millisecond. */
enum { RETURNS = 200 };

static void wait_zero(void)
{
  port_wait((intptr_t)NO_HANDLE, 0);
}

static void wait_short(void)
{
  port_wait((intptr_t)NO_HANDLE, (uint32_t)SHORT_MS);
}

static void wait_woken(void)
{
  port_wake();
  port_wait((intptr_t)NO_HANDLE, (uint32_t)LONG_MS);
}

/* Returns how often a wait for 10 ms ends within 40 ms: a port that does not rest burns the processor. */
static uint32_t returns_while_idle(void)
{
  const uint32_t start = port_time_ms();
  uint32_t count = 0;

  while (port_time_ms() - start < (uint32_t)REST_MS && count <= (uint32_t)RETURNS) {
    wait_short();
    ++count;
  }
  return count;
}

void selftest_wait(void)
{
  wait_zero(); /* takes a wake of before */
  selftest_at_most("wait_zero", (int64_t)selftest_shortest_ms(wait_zero), (int64_t)ZERO_MS, "ms");
  selftest_at_most(
    "wait_upper_bound", (int64_t)selftest_shortest_ms(wait_short), (int64_t)SHORT_MS + (int64_t)MORE_MS,
    "ms");
  selftest_at_most("wake_is_kept", (int64_t)selftest_shortest_ms(wait_woken), (int64_t)KEPT_MS, "ms");
  selftest_at_most("wait_rests", (int64_t)returns_while_idle(), (int64_t)RETURNS, "returns within 40 ms");
}
