/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros/port_bare_narrow.h"

static volatile uint32_t port_bare_now_ms; /* only the interrupt writes it */

void port_bare_tick(void)
{
  port_bare_now_ms = port_bare_now_ms + 1u;
}

uint32_t port_time_ms(void)
{
  const uint8_t state = port_bare_interrupts_off();
  const uint32_t now_ms = port_bare_now_ms;

  port_bare_interrupts_restore(state);
  return now_ms;
}
