/* SPDX-License-Identifier: Apache-2.0 */
/* stdio: {to: uart, driver: ns16550, irq: N}. A UART 16550 (PC16550D data sheet) that only sends, by its interrupt. */
#include "microros/port_board.h"
#include "microros/port_console_uart.h"
#include "microros/port_riscv.h"

#define CONSOLE_DATA (PORT_BOARD_STDIO_UART + 0u)
#define CONSOLE_DIVISOR_LOW (PORT_BOARD_STDIO_UART + 0u)
#define CONSOLE_INTERRUPTS (PORT_BOARD_STDIO_UART + 1u)
#define CONSOLE_DIVISOR_HIGH (PORT_BOARD_STDIO_UART + 1u)
#define CONSOLE_FIFO (PORT_BOARD_STDIO_UART + 2u)
#define CONSOLE_LINE (PORT_BOARD_STDIO_UART + 3u)
#define CONSOLE_STATE (PORT_BOARD_STDIO_UART + 5u)

static const uint8_t console_8n1 = 0x03;
static const uint8_t console_divisor = 0x83;
static const uint8_t console_fifo_on = 0x07;
enum { CONSOLE_FIFO_SIZE = 16 };

static const uint8_t console_no_interrupt = 0x00;
static const uint8_t console_room_interrupt = 0x02;
static const uint8_t console_state_room = 0x20; /* the FIFO is empty */

/* Fills the empty FIFO; disables the interrupt if the ring is empty. */
void port_riscv_console_interrupt(void)
{
  uint8_t byte;
  uint8_t count = 0;

  if ((PORT_RISCV_REGISTER_8(CONSOLE_STATE) & console_state_room) == 0u) {
    return;
  }
  while (count < (uint8_t)CONSOLE_FIFO_SIZE && port_console_next(&byte)) {
    PORT_RISCV_REGISTER_8(CONSOLE_DATA) = byte;
    ++count;
  }
  if (count == 0u) {
    PORT_RISCV_REGISTER_8(CONSOLE_INTERRUPTS) = console_no_interrupt;
  }
}

static void ns16550_console_start(void)
{
  static bool ns16550_console_on;

  if (!ns16550_console_on) {
    ns16550_console_on = true;
    PORT_RISCV_REGISTER_8(CONSOLE_LINE) = console_divisor;
    PORT_RISCV_REGISTER_8(CONSOLE_DIVISOR_LOW) = (uint8_t)(PORT_BOARD_STDIO_DIVISOR & 0xffu);
    PORT_RISCV_REGISTER_8(CONSOLE_DIVISOR_HIGH) = (uint8_t)(PORT_BOARD_STDIO_DIVISOR >> 8);
    PORT_RISCV_REGISTER_8(CONSOLE_LINE) = console_8n1;
    PORT_RISCV_REGISTER_8(CONSOLE_FIFO) = console_fifo_on;
    port_riscv_interrupt_enable(PORT_BOARD_STDIO_IRQ);
  }
}

/* With an empty FIFO, the interrupt occurs at once. */
void port_console_send(void)
{
  ns16550_console_start();
  PORT_RISCV_REGISTER_8(CONSOLE_INTERRUPTS) = console_room_interrupt;
}
