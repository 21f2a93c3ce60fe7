/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_bare.h"
#include "microros/port_diagnosis.h"

/* From the linker script. */
extern const uint32_t port_stack_low[];
extern const uint32_t port_stack_high[];

uint32_t port_stack_peak(void)
{
  return port_bare_stack_peak();
}

uint32_t port_stack_size(void)
{
  return (uint32_t)((uintptr_t)port_stack_high - (uintptr_t)port_stack_low);
}
