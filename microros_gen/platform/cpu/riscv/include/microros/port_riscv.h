/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of the RISC-V port that know each other. Applications have use for the registers and the interrupts alone. */
#ifndef MICROROS_PORT_RISCV_H
#define MICROROS_PORT_RISCV_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A register of 32 bit, and one of 8 bit, at an address. */
#define PORT_RISCV_REGISTER(address) (*(volatile uint32_t *)(address))
#define PORT_RISCV_REGISTER_8(address) (*(volatile uint8_t *)(address))

/* The first code after a reset: sets the stack up and goes on to port_bare_start(). */
void port_riscv_reset(void);

/* Lets interrupts of the timer and of the interrupt controller through. */
void port_riscv_interrupts_on(void);

/* Every interrupt and exception: `cause` is mcause, `pc` mepc, `value` mtval. */
void port_riscv_trap(uint32_t cause, uint32_t pc, uint32_t value);

/* Asks for the next interrupt of the timer, a millisecond after the last. */
void port_riscv_timer_next(void);

/* Calls the handler of interrupt `number` of the controller. */
void port_riscv_interrupt(uint32_t number);

/* Lets interrupt `number` of the controller through. */
void port_riscv_interrupt_enable(uint32_t number);

/* The serial line's interrupt. */
void port_riscv_uart_interrupt(void);

/* The transmit interrupt of the console. */
void port_riscv_console_interrupt(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_RISCV_H */
