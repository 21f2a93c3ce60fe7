/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the files of the RISC-V port. Applications need only the registers and the interrupts. */
#ifndef MICROROS_PORT_RISCV_H
#define MICROROS_PORT_RISCV_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The 32-bit register and the 8-bit register at an address. */
#define PORT_RISCV_REGISTER(address) (*(volatile uint32_t *)(address))
#define PORT_RISCV_REGISTER_8(address) (*(volatile uint8_t *)(address))

/* The first code after a reset: sets up the stack, then runs port_bare_start(). */
void port_riscv_reset(void);

/* Enables interrupts of the timer and of the interrupt controller. */
void port_riscv_interrupts_on(void);

/* Handles every interrupt and exception: `cause` is mcause, `pc` mepc, `value` mtval. */
void port_riscv_trap(uint32_t cause, uint32_t pc, uint32_t value);

/* Requests the next timer interrupt, one millisecond after the last one. */
void port_riscv_timer_next(void);

/* Calls the handler of interrupt `number` of the controller. */
void port_riscv_interrupt(uint32_t number);

/* Enables interrupt `number` of the controller. */
void port_riscv_interrupt_enable(uint32_t number);

/* The serial line's interrupt. */
void port_riscv_uart_interrupt(void);

/* The transmit interrupt of the console. */
void port_riscv_console_interrupt(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_RISCV_H */
