/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_bare.h"

#include <stddef.h>

/* The linker script places it, by its name, outside the memory that start-up code clears. */
static volatile struct {
  uint32_t mark;
  uint32_t cause;
  uint32_t status;
  uint32_t address;
  uint32_t pc;
  uint32_t caller;
} port_bare_fault_kept;

static const uint32_t fault_mark = 0x4641554cu;

void port_bare_fault_keep(const port_bare_fault_t * fault)
{
  port_bare_fault_kept.cause = fault->cause;
  port_bare_fault_kept.status = fault->status;
  port_bare_fault_kept.address = fault->address;
  port_bare_fault_kept.pc = fault->pc;
  port_bare_fault_kept.caller = fault->caller;
  port_bare_fault_kept.mark = fault_mark;
}

bool port_bare_fault_take(port_bare_fault_t * fault)
{
  if (fault == NULL || port_bare_fault_kept.mark != fault_mark) {
    return false;
  }
  port_bare_fault_kept.mark = 0;
  fault->cause = port_bare_fault_kept.cause;
  fault->status = port_bare_fault_kept.status;
  fault->address = port_bare_fault_kept.address;
  fault->pc = port_bare_fault_kept.pc;
  fault->caller = port_bare_fault_kept.caller;
  return true;
}

bool port_bare_fault_is_kept(void)
{
  return port_bare_fault_kept.mark == fault_mark;
}
