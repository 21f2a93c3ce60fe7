/* SPDX-License-Identifier: Apache-2.0 */
/* The reset reason of the nRF51 (Reference Manual 3.0, 12.1.5 and 12.2.6: RESETREAS). */
#include "microros/port_bare.h"
#include "microros/port_diagnosis.h"

#include <stdbool.h>
#include <stdint.h>

#define RESET_REASONS 0x40000400u

enum { RESET_PIN = 0x1, RESET_WATCHDOG = 0x2, RESET_REQUEST = 0x4, RESET_LOCKUP = 0x8 };

/* The program resets the processor after a fault, too. */
static port_reset_t reset_cause_of(uint32_t reasons)
{
  if (port_bare_fault_is_kept() || (reasons & (uint32_t)RESET_LOCKUP) != 0u) {
    return PORT_RESET_FAULT;
  }
  if ((reasons & (uint32_t)RESET_WATCHDOG) != 0u) {
    return PORT_RESET_WATCHDOG;
  }
  if ((reasons & (uint32_t)RESET_REQUEST) != 0u) {
    return PORT_RESET_SOFTWARE;
  }
  if ((reasons & (uint32_t)RESET_PIN) != 0u) {
    return PORT_RESET_PIN;
  }
  /* None: the supply was turned on or too low, which it does not tell apart. Others: it was woken from system off. */
  return reasons == 0u ? PORT_RESET_POWER : PORT_RESET_UNKNOWN;
}

/* Bits stay over later resets until a one is written to them. */
port_reset_t port_reset_cause(void)
{
  static port_reset_t cause;
  static bool is_known;

  if (!is_known) {
    volatile uint32_t * const reasons = (volatile uint32_t *)RESET_REASONS;
    const uint32_t found = *reasons;

    cause = reset_cause_of(found);
    *reasons = found;
    is_known = true;
  }
  return cause;
}
