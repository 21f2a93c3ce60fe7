/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_bare.h"
#include "microros/port_board.h"

/* The current tick is not counted, so the time is never too short. The timer wakes the processor every millisecond, so an
 * interrupt between the check and the wait delays it by one millisecond at most. */
void port_sleep_ms(uint32_t duration_ms)
{
  const uint32_t start = port_time_ms();

  if (duration_ms == 0u) {
    return;
  }
  do {
    port_board_watchdog();
    port_bare_wait();
  } while (port_time_ms() - start <= duration_ms);
}
