/* SPDX-License-Identifier: Apache-2.0 */
/* The timer (RISC-V ACLINT Specification, "MTIMER"). */
#include "microros/port.h"
#include "microros/port_board.h"
#include "microros/port_diagnosis.h"
#include "microros/port_riscv.h"

static const uint32_t us_per_ms = 1000;

/* The timer's next interrupt ends the millisecond that it is in; one that is late has not been counted yet. */
uint32_t port_time_us(void)
{
  uint32_t ms;
  uint32_t left;

  do {
    ms = port_time_ms();
    left = PORT_RISCV_REGISTER(PORT_BOARD_MTIMECMP) - PORT_RISCV_REGISTER(PORT_BOARD_MTIME);
  } while (ms != port_time_ms());
  left = left < PORT_BOARD_TICKS_PER_MS ? left : 0u;
  return ms * us_per_ms + (PORT_BOARD_TICKS_PER_MS - left) * us_per_ms / PORT_BOARD_TICKS_PER_MS;
}
