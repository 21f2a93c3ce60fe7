/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros/port_board.h"
#include "microros/port_bare_wait.h"

/* The millisecond timer wakes the processor as well, so an interrupt between a check and the wait delays it by one
 * millisecond at most. */
void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();

  (void)handle; /* the board has only one line */
  while (!port_bare_woken() && !port_bare_serial_arrived() && port_time_ms() - start < timeout_ms) {
    port_board_watchdog();
    port_bare_wait();
  }
}
