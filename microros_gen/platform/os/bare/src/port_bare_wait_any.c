/* SPDX-License-Identifier: Apache-2.0 */
/* The transport belongs to the application: what it receives raises an interrupt, and every interrupt ends the wait. */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros/port_board.h"
#include "microros/port_bare_wait.h"

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  if (timeout_ms != 0u && !port_bare_woken()) {
    port_board_watchdog();
    port_bare_wait();
  }
}
