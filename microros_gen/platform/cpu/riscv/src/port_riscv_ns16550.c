/* SPDX-License-Identifier: Apache-2.0 */
/* The UART 16550 with registers of one byte side by side (PC16550D data sheet). It buffers 16 bytes
 * of input and 16 of output. It requests interrupts while it has input, and, if enabled, while its output FIFO is empty. */
#include "microros/port_board.h"
#include "microros/port_riscv.h"
#include "microros/port_uart.h"

#define UART_DATA (PORT_BOARD_UART + 0u)
#define UART_DIVISOR_LOW (PORT_BOARD_UART + 0u)
#define UART_INTERRUPTS (PORT_BOARD_UART + 1u)
#define UART_DIVISOR_HIGH (PORT_BOARD_UART + 1u)
#define UART_FIFO (PORT_BOARD_UART + 2u)
#define UART_LINE (PORT_BOARD_UART + 3u)
#define UART_STATE (PORT_BOARD_UART + 5u)

static const uint8_t line_8n1 = 0x03;
static const uint8_t line_divisor = 0x83;
static const uint8_t fifo_on = 0x07; /* cleared, an interrupt for each byte */
enum { FIFO_SIZE = 16 };

static const uint8_t interrupt_received = 0x01;
static const uint8_t interrupt_both = 0x03; /* received data, empty output FIFO */
static const uint8_t state_ready = 0x01;
static const uint8_t state_overrun = 0x02;
static const uint8_t state_room = 0x20; /* the output FIFO is empty */

/* Fills the empty FIFO; disables its interrupt if there is nothing to send. */
static void ns16550_send_next(void)
{
  uint8_t byte;
  uint8_t count = 0;

  while (count < FIFO_SIZE && port_uart_next(&byte)) {
    PORT_RISCV_REGISTER_8(UART_DATA) = byte;
    ++count;
  }
  if (count == 0u) {
    PORT_RISCV_REGISTER_8(UART_INTERRUPTS) = interrupt_received;
  }
}

void port_riscv_uart_interrupt(void)
{
  const uint8_t state = PORT_RISCV_REGISTER_8(UART_STATE);

  if ((state & state_overrun) != 0u) {
    port_uart_lost();
  }
  if ((state & state_ready) != 0u) {
    port_uart_received(PORT_RISCV_REGISTER_8(UART_DATA));
  }
  if ((state & state_room) != 0u) {
    ns16550_send_next();
  }
}

void port_uart_start(void)
{
  PORT_RISCV_REGISTER_8(UART_LINE) = line_divisor;
  PORT_RISCV_REGISTER_8(UART_DIVISOR_LOW) = (uint8_t)(PORT_BOARD_UART_DIVISOR & 0xffu);
  PORT_RISCV_REGISTER_8(UART_DIVISOR_HIGH) = (uint8_t)(PORT_BOARD_UART_DIVISOR >> 8);
  PORT_RISCV_REGISTER_8(UART_LINE) = line_8n1;
  PORT_RISCV_REGISTER_8(UART_FIFO) = fifo_on;
  PORT_RISCV_REGISTER_8(UART_INTERRUPTS) = interrupt_received;
  port_riscv_interrupt_enable(PORT_BOARD_UART_IRQ);
}

void port_uart_stop(void)
{
  PORT_RISCV_REGISTER_8(UART_INTERRUPTS) = 0;
}

/* If the FIFO is empty, the interrupt occurs at once. */
void port_uart_send(void)
{
  PORT_RISCV_REGISTER_8(UART_INTERRUPTS) = interrupt_both;
}
