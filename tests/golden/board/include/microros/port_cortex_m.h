/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the files of the Cortex-M port. Applications need only the registers and the interrupts. */
#ifndef MICROROS_PORT_CORTEX_M_H
#define MICROROS_PORT_CORTEX_M_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The 32-bit register at an address. */
#define PORT_CORTEX_M_REGISTER(address) (*(volatile uint32_t *)(address))

/* The first code after a reset: fills the stack with a pattern, then runs port_bare_start(). */
void port_cortex_m_reset(void);

/* Handles exceptions and interrupts without their own handler: records the cause and resets the board. */
void port_cortex_m_fault(void);

/* Its second half. `frame` points to the registers that the processor saved; NULL: not readable. */
void port_cortex_m_fault_record(const uint32_t * frame);

/* The serial line's interrupt. */
void port_cortex_m_uart_interrupt(void);

/* The transmit interrupt of the console. */
void port_cortex_m_console_interrupt(void);

/* Enables interrupt `number` (0 is the first one after the processor's 16 exceptions). */
void port_cortex_m_interrupt_enable(uint32_t number);

/* Sets interrupt `number` pending, as if its device had requested it (NVIC_ISPR). */
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
