/* SPDX-License-Identifier: Apache-2.0 */
/* The reset flags of an AVR (ATmega328P data sheet, 11.9.1: MCUSR). A bootloader that clears them leaves none: unknown. */
#include "microros/port_diagnosis.h"

#include <avr/io.h>
#include <stdbool.h>

/* Power on may set the flags of a brown-out and of the pin as well. */
static port_reset_t reset_cause_of(uint8_t flags)
{
  if ((flags & (uint8_t)_BV(WDRF)) != 0u) {
    return PORT_RESET_WATCHDOG;
  }
  if ((flags & (uint8_t)_BV(PORF)) != 0u) {
    return PORT_RESET_POWER;
  }
  if ((flags & (uint8_t)_BV(BORF)) != 0u) {
    return PORT_RESET_BROWN_OUT;
  }
  return (flags & (uint8_t)_BV(EXTRF)) != 0u ? PORT_RESET_PIN : PORT_RESET_UNKNOWN;
}

/* Flags stay over later resets until they are cleared. */
port_reset_t port_reset_cause(void)
{
  static port_reset_t cause;
  static bool is_known;

  if (!is_known) {
    cause = reset_cause_of(MCUSR);
    MCUSR = 0;
    is_known = true;
  }
  return cause;
}
