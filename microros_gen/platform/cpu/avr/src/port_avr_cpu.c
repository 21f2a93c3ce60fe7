/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_bare.h"
#include "microros/port_bare_narrow.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

uint8_t port_bare_interrupts_off(void)
{
  const uint8_t state = SREG;

  cli();
  return state;
}

void port_bare_interrupts_restore(uint8_t state)
{
  SREG = state;
}

/* In idle mode timer and USART go on, and each of their interrupts wakes the processor. */
void port_bare_wait(void)
{
  SMCR = _BV(SE); /* idle */
  sleep_cpu();
  SMCR = 0;
}
