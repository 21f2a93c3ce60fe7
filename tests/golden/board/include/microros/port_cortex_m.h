/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of the Cortex-M port that know each other. Applications have use for the registers and the interrupts alone. */
#ifndef MICROROS_PORT_CORTEX_M_H
#define MICROROS_PORT_CORTEX_M_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A register of 32 bit at an address. */
#define PORT_CORTEX_M_REGISTER(address) (*(volatile uint32_t *)(address))

/* The first code after a reset: paints the stack and goes on to port_bare_start(). */
void port_cortex_m_reset(void);

/* Every exception and interrupt without its own handler: keeps the cause and restarts the board. */
void port_cortex_m_fault(void);

/* Its second half: `frame` is where the processor saved its registers, NULL where that is not readable. */
void port_cortex_m_fault_record(const uint32_t * frame);

/* The serial line's interrupt. */
void port_cortex_m_uart_interrupt(void);

/* The transmit interrupt of the console. */
void port_cortex_m_console_interrupt(void);

/* Lets interrupt `number` through (0 is the first one after the processor's own 16). */
void port_cortex_m_interrupt_enable(uint32_t number);

/* Makes interrupt `number` come, as if its device had asked (NVIC_ISPR). */
static inline void port_cortex_m_interrupt_pend(uint32_t number)
{
  PORT_CORTEX_M_REGISTER(0xe000e200u + 4u * (number / 32u)) = (uint32_t)1 << (number % 32u);
}

/* Waits until all memory accesses are complete and later instructions are fetched again (DSB, ISB). */
void port_cortex_m_barrier(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_CORTEX_M_H */
