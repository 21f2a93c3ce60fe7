/* SPDX-License-Identifier: Apache-2.0 */
/* stdio: {to: uart, irq: N}. Prints through the ring of the console, so that printed text and log messages keep their order. */
#include "microros/port.h"
#include "microros/port_console_uart.h"
#include "microros/port_stdio.h"

enum { BYTE_TIMEOUT_MS = 40 }; /* ten bits at 300 baud take 34 */

/* Waits while the ring is full. If the line is stalled, the byte is lost. */
void port_stdio_put(uint8_t byte)
{
  const uint32_t start = port_time_ms();

  while (!port_console_put(&byte, 1)) {
    if (port_time_ms() - start > BYTE_TIMEOUT_MS) {
      return;
    }
  }
}
