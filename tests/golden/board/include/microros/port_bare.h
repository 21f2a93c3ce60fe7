/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the ports without an operating system add to microros/port.h. One task calls all of it, unless said otherwise.
 *
 * In a vendor's firmware nothing of this collides: no name of CMSIS is taken, the start-up is linked by its own linker
 * script only, and each function is linked when something calls it. Such a firmware calls port_bare_tick() from its
 * own timer interrupt (Cortex-M: SysTick_Handler), or provides its own port_time_ms().
 */
#ifndef MICROROS_PORT_BARE_H
#define MICROROS_PORT_BARE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Counts a millisecond. For the timer interrupt; the image's own start-up has one. */
void port_bare_tick(void);

/* Sets the time of day: nanoseconds since 1970-01-01 00:00 UTC. Until then port_time_epoch_ns() is 0. It counts on
 * with the millisecond timer, and has to be asked once in 49 days at least. */
void port_bare_epoch_set(int64_t now_ns);

/* Returns the most bytes of stack that were ever used since the reset, interrupts included. Only in an image with this
 * project's start-up: it paints the stack before anything runs on it. */
uint32_t port_bare_stack_peak(void);

/* Returns how many bytes of the serial line were lost since the reset: the interrupt came too late for the hardware, or
 * nobody read what had arrived. */
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

/* Keeps `fault` over the reset that follows. For the handlers of a port. */
void port_bare_fault_keep(const port_bare_fault_t * fault);

/* Sleeps until an interrupt occurs. Each processor implements it. */
void port_bare_wait(void);

/* Restarts the board; does not return. Each port has its own. */
void port_bare_reset(void);

/* Begins the timer's interrupts, and what else the processor needs before C runs. Each port has its own. */
void port_bare_board_init(void);

/* Goes on after the processor's own first steps: sets up variables, runs main(), and restarts the board a second after
 * main() has returned. Does not return. */
void port_bare_start(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_BARE_H */
