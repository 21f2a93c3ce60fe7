/* SPDX-License-Identifier: Apache-2.0 */
/* stdio: {to: uart, driver: cmsdk, irq: N}. A UART of Arm's Cortex-M System Design Kit (DDI 0479, "APB UART") that only
 * sends, by its transmit interrupt. */
#include "microros/port_board.h"
#include "microros/port_console_uart.h"
#include "microros/port_cortex_m.h"

#define CONSOLE_DATA (PORT_BOARD_STDIO_UART + 0x00u)
#define CONSOLE_STATE (PORT_BOARD_STDIO_UART + 0x04u)
#define CONSOLE_CTRL (PORT_BOARD_STDIO_UART + 0x08u)
#define CONSOLE_INTCLEAR (PORT_BOARD_STDIO_UART + 0x0cu)
#define CONSOLE_BAUDDIV (PORT_BOARD_STDIO_UART + 0x10u)

static const uint32_t console_state_full = 1u << 0;
static const uint32_t console_control = 0x05u; /* transmitter and its interrupt */
static const uint32_t console_clear = 1u << 0;

void port_cortex_m_console_interrupt(void)
{
  uint8_t byte;

  PORT_CORTEX_M_REGISTER(CONSOLE_INTCLEAR) = console_clear;
  if ((PORT_CORTEX_M_REGISTER(CONSOLE_STATE) & console_state_full) == 0u && port_console_next(&byte)) {
    PORT_CORTEX_M_REGISTER(CONSOLE_DATA) = byte;
  }
}

static void cmsdk_console_start(void)
{
  static bool cmsdk_console_on;

  if (!cmsdk_console_on) {
    cmsdk_console_on = true;
    PORT_CORTEX_M_REGISTER(CONSOLE_BAUDDIV) = PORT_BOARD_STDIO_DIVISOR;
    PORT_CORTEX_M_REGISTER(CONSOLE_CTRL) = console_control;
    port_cortex_m_interrupt_enable(PORT_BOARD_STDIO_IRQ);
  }
}

/* Only the interrupt writes to the data register. */
void port_console_send(void)
{
  cmsdk_console_start();
  port_cortex_m_interrupt_pend(PORT_BOARD_STDIO_IRQ);
}
