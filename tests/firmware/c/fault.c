/* SPDX-License-Identifier: Apache-2.0 */
/* Fails on purpose, once: after the restart it keeps the cause where the test's monitor finds it. */
#include <microros/port.h>
#include <microros/port_bare.h>

typedef struct fault_report_t {
  uint32_t done;
  uint32_t cause;
  uint32_t status;
  uint32_t address;
  uint32_t pc;
  uint32_t fail; /* where it fails, for comparison */
} fault_report_t;

volatile fault_report_t fault_report;

void fail(uint32_t depth);

/* Both are looked up when they are used, so that nothing is known of them before. */
static void (*volatile way)(uint32_t) = fail;
#ifndef FAULT_STACK
static volatile uintptr_t address = FAULT_ADDRESS;
#endif

#ifdef FAULT_STACK
void fail(uint32_t depth)
{
  volatile uint32_t frame[16];

  frame[0] = depth;
  if (depth != 0u) { /* always */
    fail(frame[0] + 1u);
  }
  frame[1] = depth; /* so that the call is no jump */
}
#else
void fail(uint32_t depth)
{
  *(volatile uint32_t *)address = depth;
}
#endif

int main(void)
{
  port_bare_fault_t fault;

  if (!port_bare_fault_take(&fault)) {
    way(1);
    return 1;
  }
  fault_report.cause = fault.cause;
  fault_report.status = fault.status;
  fault_report.address = fault.address;
  fault_report.pc = fault.pc;
  fault_report.fail = (uint32_t)(uintptr_t)fail;
  fault_report.done = 1;
  for (;;) {
    port_sleep_ms(1000);
  }
}
