/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_pool.h"
#include "selftest_report.h"

enum { NO_HANDLE = -1, SOON_MS = 20, LONG_MS = 500, WOKEN_MS = 250 };

static void wake_soon(uint8_t task)
{
  (void)task;
  port_sleep_ms((uint32_t)SOON_MS);
  port_wake();
}

/* A wait may also end before the wake. */
void selftest_task_wake(void)
{
  const uint32_t start_ms = port_time_ms();

  if (!selftest_start(SELFTEST_LOW, wake_soon)) {
    return;
  }
  while (port_time_ms() - start_ms < (uint32_t)SOON_MS) {
    port_wait((intptr_t)NO_HANDLE, (uint32_t)LONG_MS);
  }
  selftest_at_most("wake_from_task", (int64_t)(port_time_ms() - start_ms), (int64_t)WOKEN_MS, "ms");
  port_task_join(SELFTEST_LOW);
}
