/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_pool.h"
#include "selftest_report.h"

enum { ROUNDS = 10, BOTH = 2 };

static uint32_t shared; /* guarded by the lock */

/* The other task runs during the sleep: only the lock keeps it from this value, also when one of two calls was undone. */
static void add(uint8_t task)
{
  (void)task;
  for (int i = 0; i < (int)ROUNDS; ++i) {
    uint32_t value;

    port_lock();
    port_lock();
    port_unlock();
    value = shared;
    port_sleep_ms(1);
    shared = value + 1u;
    port_unlock();
  }
}

void selftest_exclusion(void)
{
  bool is_second;

  shared = 0;
  if (!selftest_start(SELFTEST_LOW, add)) {
    return;
  }
  is_second = selftest_start(SELFTEST_MIDDLE, add);
  port_task_join(SELFTEST_LOW);
  if (is_second) {
    port_task_join(SELFTEST_MIDDLE);
    selftest_equal("lock_excludes", (int64_t)shared, (int64_t)ROUNDS * (int64_t)BOTH, "additions");
  }
}
