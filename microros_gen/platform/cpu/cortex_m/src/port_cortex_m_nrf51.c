/* SPDX-License-Identifier: Apache-2.0 */
/* The UART of Nordic's nRF51 (Reference Manual, "UART"). It buffers six bytes of input, and requests interrupts
 * until all of them are read. */
#include "microros/port_board.h"
#include "microros/port_cortex_m.h"
#include "microros/port_uart.h"

#define UART_START_RX (PORT_BOARD_UART + 0x000u)
#define UART_START_TX (PORT_BOARD_UART + 0x008u)
#define UART_RX_READY (PORT_BOARD_UART + 0x108u)
#define UART_TX_READY (PORT_BOARD_UART + 0x11cu)
#define UART_INTERRUPTS (PORT_BOARD_UART + 0x304u)
#define UART_ERRORS (PORT_BOARD_UART + 0x480u)
#define UART_ENABLE (PORT_BOARD_UART + 0x500u)
#define UART_TX_PIN (PORT_BOARD_UART + 0x50cu)
#define UART_RX_PIN (PORT_BOARD_UART + 0x514u)
#define UART_RX_DATA (PORT_BOARD_UART + 0x518u)
#define UART_TX_DATA (PORT_BOARD_UART + 0x51cu)
#define UART_BAUD (PORT_BOARD_UART + 0x524u)

static const uint32_t enabled = 4;
static const uint32_t interrupts = 1u << 2 | 1u << 7; /* byte received, byte sent */
static const uint32_t error_overrun = 1u << 0;

static bool nrf51_sends; /* a byte is being sent; written by the interrupt and by port_uart_start */

static void nrf51_send_next(void)
{
  uint8_t byte;

  if (PORT_CORTEX_M_REGISTER(UART_TX_READY) != 0u) {
    PORT_CORTEX_M_REGISTER(UART_TX_READY) = 0;
    nrf51_sends = false;
  }
  if (!nrf51_sends && port_uart_next(&byte)) {
    nrf51_sends = true;
    PORT_CORTEX_M_REGISTER(UART_TX_DATA) = byte;
  }
}

void port_cortex_m_uart_interrupt(void)
{
  const uint32_t errors = PORT_CORTEX_M_REGISTER(UART_ERRORS);

  if (errors != 0u) {
    PORT_CORTEX_M_REGISTER(UART_ERRORS) = errors;
  }
  if ((errors & error_overrun) != 0u) {
    port_uart_lost();
  }
  if (PORT_CORTEX_M_REGISTER(UART_RX_READY) != 0u) {
    PORT_CORTEX_M_REGISTER(UART_RX_READY) = 0;
    port_uart_received((uint8_t)(PORT_CORTEX_M_REGISTER(UART_RX_DATA) & 0xffu));
  }
  nrf51_send_next();
}

void port_uart_start(void)
{
  PORT_CORTEX_M_REGISTER(UART_TX_PIN) = PORT_BOARD_UART_TX_PIN;
  PORT_CORTEX_M_REGISTER(UART_RX_PIN) = PORT_BOARD_UART_RX_PIN;
  PORT_CORTEX_M_REGISTER(UART_BAUD) = PORT_BOARD_UART_DIVISOR;
  PORT_CORTEX_M_REGISTER(UART_ENABLE) = enabled;
  PORT_CORTEX_M_REGISTER(UART_TX_READY) = 0;
  nrf51_sends = false;
  PORT_CORTEX_M_REGISTER(UART_INTERRUPTS) = interrupts;
  PORT_CORTEX_M_REGISTER(UART_START_TX) = 1;
  PORT_CORTEX_M_REGISTER(UART_START_RX) = 1;
  port_cortex_m_interrupt_enable(PORT_BOARD_UART_IRQ);
}

void port_uart_stop(void)
{
  PORT_CORTEX_M_REGISTER(UART_ENABLE) = 0;
}

/* Only the interrupt accesses the transmitter. */
void port_uart_send(void)
{
  port_cortex_m_interrupt_pend(PORT_BOARD_UART_IRQ);
}
