/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_bare.h"

/* One word, read and written atomically; only the interrupt writes it. */
static volatile uint32_t port_bare_now_ms;

void port_bare_tick(void)
{
  port_bare_now_ms = port_bare_now_ms + 1u;
}

uint32_t port_time_ms(void)
{
  return port_bare_now_ms;
}
