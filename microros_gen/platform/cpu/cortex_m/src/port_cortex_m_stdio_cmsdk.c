/* SPDX-License-Identifier: Apache-2.0 */
/* stdio: {to: uart, driver: cmsdk}. A UART that only sends, without interrupts: printing waits for it. */
#include "microros/port.h"
#include "microros/port_board.h"
#include "microros/port_cortex_m.h"
#include "microros/port_stdio.h"

#define STDIO_DATA (PORT_BOARD_STDIO_UART + 0x00u)
#define STDIO_STATE (PORT_BOARD_STDIO_UART + 0x04u)
#define STDIO_CTRL (PORT_BOARD_STDIO_UART + 0x08u)
#define STDIO_BAUDDIV (PORT_BOARD_STDIO_UART + 0x10u)

enum { BYTE_TIMEOUT_MS = 40 }; /* ten bits at 300 baud take 34 */

static const uint32_t state_tx_full = 1u << 0;
static const uint32_t control_transmitter = 1u << 0;

/* If the line is stalled, the byte is lost. */
void port_stdio_put(uint8_t byte)
{
  const uint32_t start = port_time_ms();

  PORT_CORTEX_M_REGISTER(STDIO_BAUDDIV) = PORT_BOARD_STDIO_DIVISOR;
  PORT_CORTEX_M_REGISTER(STDIO_CTRL) = control_transmitter;
  while ((PORT_CORTEX_M_REGISTER(STDIO_STATE) & state_tx_full) != 0u) {
    if (port_time_ms() - start > BYTE_TIMEOUT_MS) {
      return;
    }
  }
  PORT_CORTEX_M_REGISTER(STDIO_DATA) = byte;
}
