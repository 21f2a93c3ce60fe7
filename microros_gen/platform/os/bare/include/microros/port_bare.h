/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Additions of ports without an operating system to microros/port.h. One task calls all of them, unless noted otherwise.
 *
 * They do not collide with a vendor's firmware: no CMSIS name is used, start-up code is linked only with this project's
 * linker script, and each function only if something calls it. Such firmware calls port_bare_tick() from its own timer
 * interrupt (Cortex-M: SysTick_Handler), or provides its own port_time_ms().
 */
#ifndef MICROROS_PORT_BARE_H
#define MICROROS_PORT_BARE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Counts a millisecond; called by the timer interrupt. An image with this project's start-up code has one. */
void port_bare_tick(void);

/* Sets the time of day: nanoseconds since 1970-01-01 00:00 UTC. Until then port_time_epoch_ns() returns 0.
 * Afterwards port_time_steady_ns() advances it. */
void port_bare_epoch_set(int64_t now_ns);

/* Returns the high-water mark of the stack since the reset in bytes, interrupts included. Only in an image with this
 * project's start-up code, which fills the stack with a pattern before it is used. */
uint32_t port_bare_stack_peak(void);

/* Returns how many bytes of the serial line were lost since the reset, because the interrupt was served too late or the
 * receive ring was full. */
uint32_t port_bare_serial_lost(void);

/* Why the processor stopped. `cause` is the number of the exception (Cortex-M: 3 HardFault …; 16 and above: an interrupt
 * without a handler) or mcause (RISC-V); `status` CFSR, 0 on RISC-V and Cortex-M0/M0+; `address` the faulty address
 * (BFAR or MMFAR where CFSR says that they hold one; mtval); `pc` and `caller` where it happened, 0 after an overflow
 * of the stack on Cortex-M. */
typedef struct port_bare_fault_t {
  uint32_t cause;
  uint32_t status;
  uint32_t address;
  uint32_t pc;
  uint32_t caller;
} port_bare_fault_t;

/* After a reset caused by a fault: returns true once, with the record of the fault. */
bool port_bare_fault_take(port_bare_fault_t * fault);

/* Returns whether the last reset was caused by a fault whose record was not taken yet. */
bool port_bare_fault_is_kept(void);

/* Stores `fault` across the following reset. For the fault handlers of a port. */
void port_bare_fault_keep(const port_bare_fault_t * fault);

/* Sleeps until an interrupt occurs. Implemented by each processor. */
void port_bare_wait(void);

/* Resets the board; does not return. Implemented by each processor. */
void port_bare_reset(void);

/* Starts the timer interrupt and prepares the processor for main(). Implemented by each processor. */
void port_bare_board_init(void);

/* Called after the processor-specific start-up code: initializes variables, runs main(), and resets the board one second
 * after main() has returned. Does not return. */
void port_bare_start(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_BARE_H */
