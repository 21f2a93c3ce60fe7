/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The driver of the Nucleo-F446RE's serial line: USART2, which the board's ST-LINK shows to the computer as a serial device.
 * Both directions wait in rings of the library, which the interrupt fills and empties. Registers: ST RM0390, "RCC", "GPIO",
 * "USART".
 */
#include "../counter.h"

#include <microros/port_board.h>
#include <microros/port_cortex_m.h>
#include <microros/port_uart.h>

#define RCC_AHB1ENR 0x40023830u
#define RCC_APB1ENR 0x40023840u
#define GPIOA_MODER 0x40020000u
#define GPIOA_AFRL 0x40020020u
#define USART2_SR 0x40004400u
#define USART2_DR 0x40004404u
#define USART2_BRR 0x40004408u
#define USART2_CR1 0x4000440cu

enum { USART2_IRQ = 38 };

static const uint32_t clock_gpioa = 1u << 0;
static const uint32_t clock_usart2 = 1u << 17;
static const uint32_t pa2_pa3_mode = 0xfu << 4; /* of these pins, in MODER … */
static const uint32_t pa2_pa3_alternate = 0xau << 4;
static const uint32_t pa2_pa3_function = 0xffu << 8; /* … and in AFRL */
static const uint32_t pa2_pa3_usart2 = 0x77u << 8;
static const uint32_t status_overrun = 1u << 3;   /* ORE */
static const uint32_t status_receive = 1u << 5;   /* RXNE */
static const uint32_t status_transmit = 1u << 7;  /* TXE */
static const uint32_t control_on = 0x202cu;       /* UE, RXNEIE, TE, RE */
static const uint32_t control_transmit = 1u << 7; /* TXEIE */

void usart2_interrupt(void);

/* Two at most: one in the shift register, one waiting. */
static void send_bytes(void)
{
  uint8_t byte;

  while ((PORT_CORTEX_M_REGISTER(USART2_SR) & status_transmit) != 0u) {
    if (!port_uart_next(&byte)) {
      PORT_CORTEX_M_REGISTER(USART2_CR1) = control_on; /* room is of no interest now */
      return;
    }
    PORT_CORTEX_M_REGISTER(USART2_DR) = byte;
  }
}

void usart2_interrupt(void)
{
  const uint32_t status = PORT_CORTEX_M_REGISTER(USART2_SR);
  uint8_t byte;

  if ((status & (status_receive | status_overrun)) != 0u) { /* status and then data end both */
    byte = (uint8_t)(PORT_CORTEX_M_REGISTER(USART2_DR) & 0xffu);
    if ((status & status_receive) != 0u) {
      port_uart_received(byte);
    }
    if ((status & status_overrun) != 0u) {
      port_uart_lost();
    }
  }
  send_bytes();
}

void port_uart_start(void)
{
  const uint32_t clock_hz = PORT_BOARD_TICKS_PER_MS * 1000u;

  PORT_CORTEX_M_REGISTER(RCC_AHB1ENR) |= clock_gpioa;
  PORT_CORTEX_M_REGISTER(RCC_APB1ENR) |= clock_usart2;
  PORT_CORTEX_M_REGISTER(GPIOA_AFRL) =
    (PORT_CORTEX_M_REGISTER(GPIOA_AFRL) & ~pa2_pa3_function) | pa2_pa3_usart2;
  PORT_CORTEX_M_REGISTER(GPIOA_MODER) =
    (PORT_CORTEX_M_REGISTER(GPIOA_MODER) & ~pa2_pa3_mode) | pa2_pa3_alternate;
  PORT_CORTEX_M_REGISTER(USART2_BRR) = (clock_hz + PORT_BOARD_UART_BAUD / 2u) / PORT_BOARD_UART_BAUD;
  PORT_CORTEX_M_REGISTER(USART2_CR1) = control_on;
  port_cortex_m_interrupt_enable(USART2_IRQ);
}

void port_uart_stop(void)
{
  PORT_CORTEX_M_REGISTER(USART2_CR1) = 0;
}

/* If it has room, the interrupt occurs at once, and again each time it has room. It is pended as well for QEMU 7.2, whose
 * USART has no transmit interrupt; on the board the two are one. */
void port_uart_send(void)
{
  PORT_CORTEX_M_REGISTER(USART2_CR1) = control_on | control_transmit;
  port_cortex_m_interrupt_pend(USART2_IRQ);
}

int main(void)
{
  counter_run();
  return 0; /* the start-up code restarts the board after a second */
}
