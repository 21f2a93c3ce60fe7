/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Why a Pico has restarted (RP2040 data sheet, 2.12.8: CHIP_RESET, and 4.7.6: REASON; RP2350 data sheet, 6.4: CHIP_RESET,
 * and 12.9.7: REASON). The watchdog comes first: it leaves the cause of the reset before in CHIP_RESET.
 */
#include "microros/port_diagnosis.h"

#include "hardware/watchdog.h"

#if PICO_RP2040
#include "hardware/structs/vreg_and_chip_reset.h"
#else
#include "hardware/structs/powman.h"
#endif

static port_reset_t cause;

static port_reset_t reset_cause_of_chip(void)
{
#if PICO_RP2040
  const uint32_t flags = vreg_and_chip_reset_hw->chip_reset;

  if ((flags & VREG_AND_CHIP_RESET_CHIP_RESET_HAD_RUN_BITS) != 0u) {
    return PORT_RESET_PIN;
  }
  /* It does not tell apart whether the supply was turned on or too low. */
  return (flags & VREG_AND_CHIP_RESET_CHIP_RESET_HAD_POR_BITS) != 0u ? PORT_RESET_POWER : PORT_RESET_UNKNOWN;
#else
  const uint32_t flags = powman_hw->chip_reset;

  if ((flags & POWMAN_CHIP_RESET_HAD_POR_BITS) != 0u) {
    return PORT_RESET_POWER;
  }
  if ((flags & POWMAN_CHIP_RESET_HAD_BOR_BITS) != 0u) {
    return PORT_RESET_BROWN_OUT;
  }
  return (flags & POWMAN_CHIP_RESET_HAD_RUN_LOW_BITS) != 0u ? PORT_RESET_PIN : PORT_RESET_UNKNOWN;
#endif
}

/* Before main: the SDK tells both kinds of reboot apart by a word that watchdog_enable of the program changes. */
static void __attribute__((constructor)) keep_reset_cause(void)
{
  if (watchdog_enable_caused_reboot()) {
    cause = PORT_RESET_WATCHDOG;
  } else if (watchdog_caused_reboot()) { /* watchdog_reboot */
    cause = PORT_RESET_SOFTWARE;
  } else {
    cause = reset_cause_of_chip();
  }
}

port_reset_t port_reset_cause(void)
{
  return cause;
}
