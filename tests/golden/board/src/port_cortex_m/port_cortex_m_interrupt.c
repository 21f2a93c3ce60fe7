/* SPDX-License-Identifier: Apache-2.0 */
/* Registers: Armv6-M, Armv7-M and Armv8-M Architecture Reference Manuals, "Nested Vectored Interrupt Controller". */
#include "microros/port_cortex_m.h"

#define NVIC_ISER 0xe000e100u

void port_cortex_m_interrupt_enable(uint32_t number)
{
  PORT_CORTEX_M_REGISTER(NVIC_ISER + 4u * (number / 32u)) = (uint32_t)1 << (number % 32u);
}
