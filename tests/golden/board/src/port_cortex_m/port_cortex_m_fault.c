/* SPDX-License-Identifier: Apache-2.0 */
/* Registers: Armv7-M and Armv8-M Architecture Reference Manuals, "System Control Block". */
#include "microros/port_bare.h"
#include "microros/port_cortex_m.h"

#include <stddef.h>

#define SCB_CPUID 0xe000ed00u
#define SCB_ICSR 0xe000ed04u
#define SCB_CFSR 0xe000ed28u
#define SCB_MMFAR 0xe000ed34u
#define SCB_BFAR 0xe000ed38u

enum { FRAME_LR = 5, FRAME_PC = 6 };

static const uint32_t active_exception = 0x1ffu; /* in ICSR */
static const uint32_t mmfar_valid = 1u << 7;     /* in CFSR */
static const uint32_t bfar_valid = 1u << 15;

/* Armv6-M and Armv8-M Baseline have no fault status registers: the architecture field in their CPUID is 0xc, otherwise 0xf. */
static bool fault_has_status(void)
{
  return (PORT_CORTEX_M_REGISTER(SCB_CPUID) & 0x000f0000u) == 0x000f0000u;
}

static uint32_t fault_address(uint32_t status)
{
  if ((status & bfar_valid) != 0u) {
    return PORT_CORTEX_M_REGISTER(SCB_BFAR);
  }
  return (status & mmfar_valid) != 0u ? PORT_CORTEX_M_REGISTER(SCB_MMFAR) : 0u;
}

void port_cortex_m_fault_record(const uint32_t * frame)
{
  port_bare_fault_t fault = {0, 0, 0, 0, 0};

  fault.cause = PORT_CORTEX_M_REGISTER(SCB_ICSR) & active_exception;
  if (fault_has_status()) {
    fault.status = PORT_CORTEX_M_REGISTER(SCB_CFSR);
    fault.address = fault_address(fault.status);
  }
  if (frame != NULL) {
    fault.pc = frame[FRAME_PC];
    fault.caller = frame[FRAME_LR];
  }
  port_bare_fault_keep(&fault);
  port_bare_reset();
}
