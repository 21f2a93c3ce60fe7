/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_diagnosis.h"
#include "selftest_checks.h"
#include "selftest_report.h"

enum { DEEP = 512 };

/* The high-water mark must reach this call's array. */
static uint32_t peak_below(void)
{
  volatile uint8_t bytes[DEEP];

  for (uint32_t i = 0; i < (uint32_t)DEEP; ++i) {
    bytes[i] = (uint8_t)i;
  }
  return port_stack_peak() + (uint32_t)bytes[0];
}

void selftest_stack_peak(void)
{
  const uint32_t peak = peak_below();

  selftest_at_least("stack_peak", (int64_t)peak, (int64_t)DEEP, "bytes");
  selftest_at_most("stack_peak_fits", (int64_t)peak, (int64_t)port_stack_size(), "bytes");
}
