/* SPDX-License-Identifier: Apache-2.0 */
/* stdio: {to: uart, driver: ns16550}. A UART that only sends, without interrupts: printing waits for it. */
#include "microros/port.h"
#include "microros/port_board.h"
#include "microros/port_riscv.h"
#include "microros/port_stdio.h"

#include <stdbool.h>

#define STDIO_DATA (PORT_BOARD_STDIO_UART + 0u)
#define STDIO_DIVISOR_LOW (PORT_BOARD_STDIO_UART + 0u)
#define STDIO_DIVISOR_HIGH (PORT_BOARD_STDIO_UART + 1u)
#define STDIO_LINE (PORT_BOARD_STDIO_UART + 3u)
#define STDIO_STATE (PORT_BOARD_STDIO_UART + 5u)

enum { BYTE_TIMEOUT_MS = 40 }; /* ten bits at 300 baud take 34 */

static const uint8_t line_8n1 = 0x03;
static const uint8_t line_divisor = 0x83;
static const uint8_t state_room = 0x20;

static void stdio_start(void)
{
  static bool started;

  if (!started) {
    PORT_RISCV_REGISTER_8(STDIO_LINE) = line_divisor;
    PORT_RISCV_REGISTER_8(STDIO_DIVISOR_LOW) = (uint8_t)(PORT_BOARD_STDIO_DIVISOR & 0xffu);
    PORT_RISCV_REGISTER_8(STDIO_DIVISOR_HIGH) = (uint8_t)(PORT_BOARD_STDIO_DIVISOR >> 8);
    PORT_RISCV_REGISTER_8(STDIO_LINE) = line_8n1;
    started = true;
  }
}

/* If the line is stalled, the byte is lost. */
void port_stdio_put(uint8_t byte)
{
  const uint32_t start = port_time_ms();

  stdio_start();
  while ((PORT_RISCV_REGISTER_8(STDIO_STATE) & state_room) == 0u) {
    if (port_time_ms() - start > BYTE_TIMEOUT_MS) {
      return;
    }
  }
  PORT_RISCV_REGISTER_8(STDIO_DATA) = byte;
}
