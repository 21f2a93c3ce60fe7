/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An AVR that sends a digit with the cause of each reset, read twice: at first it is turned on, then its watchdog
 * resets it, and at last it is as after a bootloader that has cleared the flags.
 */
#include <avr/io.h>
#include <avr/wdt.h>
#include <microros/port_diagnosis.h>

enum { HALF_BIT_CYCLES = 16 }; /* 115,200 baud at 16 MHz: UBRR with U2X */

static void send(port_reset_t cause)
{
  while ((UCSR0A & _BV(UDRE0)) == 0) {
  }
  UDR0 = (uint8_t)('0' + cause);
}

int main(void)
{
  port_reset_t cause;

  UBRR0 = HALF_BIT_CYCLES;
  UCSR0A = _BV(U2X0);
  UCSR0B = _BV(TXEN0);
  cause = port_reset_cause();
  wdt_disable();
  send(cause);
  send(port_reset_cause());
  send((port_reset_t)(MCUSR & 0x0f)); /* cleared */
  if (cause == PORT_RESET_POWER) {
    wdt_enable(WDTO_120MS);
  }
  for (;;) {
  }
}
