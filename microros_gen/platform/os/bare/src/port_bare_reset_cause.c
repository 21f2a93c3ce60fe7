/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_bare.h"
#include "microros/port_diagnosis.h"

/* Nothing but a fault leaves a trace that is the same on all boards. */
port_reset_t port_reset_cause(void)
{
  static bool was_fault;

  was_fault = was_fault || port_bare_fault_is_kept();
  return was_fault ? PORT_RESET_FAULT : PORT_RESET_UNKNOWN;
}
