/* SPDX-License-Identifier: Apache-2.0 */
/* The UART of Arm's Cortex-M System Design Kit (DDI 0479, "APB UART"). It buffers one byte of input and
 * one of output. Each received and each sent byte requests an interrupt: two numbers with one handler. */
#include "microros/port_board.h"
#include "microros/port_cortex_m.h"
#include "microros/port_uart.h"

#define UART_DATA (PORT_BOARD_UART + 0x00u)
#define UART_STATE (PORT_BOARD_UART + 0x04u)
#define UART_CTRL (PORT_BOARD_UART + 0x08u)
#define UART_INTCLEAR (PORT_BOARD_UART + 0x0cu)
#define UART_BAUDDIV (PORT_BOARD_UART + 0x10u)

static const uint32_t state_tx_full = 1u << 0;
static const uint32_t state_rx_full = 1u << 1;
static const uint32_t state_rx_overrun = 1u << 3;
static const uint32_t control_on =
  0x2fu; /* transmitter, receiver, their interrupts, receive overrun interrupt */
static const uint32_t clear_all = 0x0bu; /* of these three */

void port_cortex_m_uart_interrupt(void)
{
  uint8_t byte;

  PORT_CORTEX_M_REGISTER(UART_INTCLEAR) = clear_all;
  if ((PORT_CORTEX_M_REGISTER(UART_STATE) & state_rx_overrun) != 0u) {
    PORT_CORTEX_M_REGISTER(UART_STATE) = state_rx_overrun;
    port_uart_lost();
  }
  if ((PORT_CORTEX_M_REGISTER(UART_STATE) & state_rx_full) != 0u) {
    port_uart_received((uint8_t)(PORT_CORTEX_M_REGISTER(UART_DATA) & 0xffu));
  }
  if ((PORT_CORTEX_M_REGISTER(UART_STATE) & state_tx_full) == 0u && port_uart_next(&byte)) {
    PORT_CORTEX_M_REGISTER(UART_DATA) = byte;
  }
}

void port_uart_start(void)
{
  PORT_CORTEX_M_REGISTER(UART_BAUDDIV) = PORT_BOARD_UART_DIVISOR;
  PORT_CORTEX_M_REGISTER(UART_CTRL) = control_on;
  port_cortex_m_interrupt_enable(PORT_BOARD_UART_IRQ);
  port_cortex_m_interrupt_enable(PORT_BOARD_UART_TX_IRQ);
}

void port_uart_stop(void)
{
  PORT_CORTEX_M_REGISTER(UART_CTRL) = 0;
}

/* Only the interrupt accesses the data register. */
void port_uart_send(void)
{
  port_cortex_m_interrupt_pend(PORT_BOARD_UART_TX_IRQ);
}
