/* SPDX-License-Identifier: Apache-2.0 */
/* Registers: Armv6-M, Armv7-M and Armv8-M Architecture Reference Manuals, "SysTick Current Value Register". */
#include "microros/port.h"
#include "microros/port_board.h"
#include "microros/port_cortex_m.h"
#include "microros/port_diagnosis.h"

#define SYST_CVR 0xe000e018u

static const uint32_t us_per_ms = 1000;

/* SysTick counts down to 0 in each millisecond, which its interrupt counts. */
uint32_t port_time_us(void)
{
  uint32_t ms;
  uint32_t left;

  do {
    ms = port_time_ms();
    left = PORT_CORTEX_M_REGISTER(SYST_CVR);
  } while (ms != port_time_ms());
  return ms * us_per_ms + (PORT_BOARD_TICKS_PER_MS - 1u - left) * us_per_ms / PORT_BOARD_TICKS_PER_MS;
}
