/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_bare.h"

/* From the linker script. Start-up code fills the stack with this word; it grows downwards. */
extern const uint32_t port_stack_low[];
extern const uint32_t port_stack_high[];

static const uint32_t fill_pattern = 0xc5c5c5c5u;

uint32_t port_bare_stack_peak(void)
{
  const volatile uint32_t * at = port_stack_low;
  uint32_t unused = 0;

  while (at != port_stack_high && *at == fill_pattern) {
    ++at;
    unused += (uint32_t)sizeof(*at);
  }
  return (uint32_t)((uintptr_t)port_stack_high - (uintptr_t)port_stack_low) - unused;
}
