/* SPDX-License-Identifier: Apache-2.0 */
/* The timer (RISC-V ACLINT Specification, "MTIMER") and the interrupt controller (RISC-V PLIC Specification), both for hart 0
 * in machine mode, which is context 0. */
#include "microros/port_bare.h"
#include "microros/port_board.h"
#include "microros/port_riscv.h"

#define PLIC_PRIORITY(number) (PORT_BOARD_PLIC + 4u * (number))
#define PLIC_ENABLE(number) (PORT_BOARD_PLIC + 0x2000u + 4u * ((number) / 32u))
#define PLIC_THRESHOLD (PORT_BOARD_PLIC + 0x200000u)

static uint64_t port_riscv_due;

static uint64_t timer_now(void)
{
  uint32_t high;
  uint32_t low;

  do {
    high = PORT_RISCV_REGISTER(PORT_BOARD_MTIME + 4u);
    low = PORT_RISCV_REGISTER(PORT_BOARD_MTIME);
  } while (high != PORT_RISCV_REGISTER(PORT_BOARD_MTIME + 4u));
  return (uint64_t)high << 32 | low;
}

void port_riscv_timer_next(void)
{
  port_riscv_due += PORT_BOARD_TICKS_PER_MS;
  PORT_RISCV_REGISTER(PORT_BOARD_MTIMECMP + 4u) = UINT32_MAX; /* neither half alone can be due */
  PORT_RISCV_REGISTER(PORT_BOARD_MTIMECMP) = (uint32_t)port_riscv_due;
  PORT_RISCV_REGISTER(PORT_BOARD_MTIMECMP + 4u) = (uint32_t)(port_riscv_due >> 32);
}

void port_bare_board_init(void)
{
  port_riscv_due = timer_now();
  port_riscv_timer_next();
  PORT_RISCV_REGISTER(PLIC_THRESHOLD) = 0;
  port_riscv_interrupts_on();
}

void port_riscv_interrupt_enable(uint32_t number)
{
  PORT_RISCV_REGISTER(PLIC_PRIORITY(number)) = 1;
  PORT_RISCV_REGISTER(PLIC_ENABLE(number)) |= (uint32_t)1 << (number % 32u);
}
