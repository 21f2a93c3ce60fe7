/* SPDX-License-Identifier: Apache-2.0 */
/* Registers: Armv6-M, Armv7-M and Armv8-M Architecture Reference Manuals, "System Control Space". */
#include "microros/port_bare.h"
#include "microros/port_board.h"
#include "microros/port_cortex_m.h"

#define SYST_CSR 0xe000e010u
#define SYST_RVR 0xe000e014u
#define SYST_CVR 0xe000e018u
#define SCB_VTOR 0xe000ed08u
#define SCB_AIRCR 0xe000ed0cu
#define SCB_CPACR 0xe000ed88u

static const uint32_t systick_start = 7u;          /* ENABLE, TICKINT, CLKSOURCE: the processor's clock */
static const uint32_t reset_request = 0x05fa0004u; /* the key, SYSRESETREQ */
static const uint32_t fpu_access = 0x00f00000u;    /* CP10 and CP11 */

void port_bare_board_init(void)
{
  if (PORT_BOARD_VECTORS != 0u) { /* a bootloader with its own table ran before */
    PORT_CORTEX_M_REGISTER(SCB_VTOR) = PORT_BOARD_VECTORS;
    port_cortex_m_barrier();
  }
  if (PORT_BOARD_HAS_FPU != 0u) {
    PORT_CORTEX_M_REGISTER(SCB_CPACR) |= fpu_access;
    port_cortex_m_barrier();
  }
  PORT_CORTEX_M_REGISTER(SYST_RVR) = PORT_BOARD_TICKS_PER_MS - 1u;
  PORT_CORTEX_M_REGISTER(SYST_CVR) = 0;
  PORT_CORTEX_M_REGISTER(SYST_CSR) = systick_start;
}

void port_bare_reset(void)
{
  port_cortex_m_barrier();
  PORT_CORTEX_M_REGISTER(SCB_AIRCR) = reset_request;
  for (;;) {
    port_cortex_m_barrier(); /* until the reset takes effect */
  }
}
