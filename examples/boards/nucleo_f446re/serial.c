/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The serial line of the Nucleo-F446RE: USART2, which the board's ST-LINK shows to the computer as a serial device. What
 * comes in waits in a ring, which the interrupt fills and the library empties. Registers: ST RM0390, "RCC", "GPIO", "USART".
 */
#include "../counter.h"

#include <microros/port.h>
#include <microros/port_board.h>
#include <microros/port_cortex_m.h>

#define RCC_AHB1ENR 0x40023830u
#define RCC_APB1ENR 0x40023840u
#define GPIOA_MODER 0x40020000u
#define GPIOA_AFRL 0x40020020u
#define USART2_SR 0x40004400u
#define USART2_DR 0x40004404u
#define USART2_BRR 0x40004408u
#define USART2_CR1 0x4000440cu

enum { USART2_IRQ = 38, RING_SIZE = 256, BYTE_TIMEOUT_MS = 10 };

static const uint32_t clock_gpioa = 1u << 0;
static const uint32_t clock_usart2 = 1u << 17;
static const uint32_t pa2_pa3_mode = 0xfu << 4; /* of these pins, in MODER … */
static const uint32_t pa2_pa3_alternate = 0xau << 4;
static const uint32_t pa2_pa3_function = 0xffu << 8; /* … and in AFRL */
static const uint32_t pa2_pa3_usart2 = 0x77u << 8;
static const uint32_t status_receive = 1u << 5;  /* RXNE */
static const uint32_t status_transmit = 1u << 7; /* TXE */
static const uint32_t control_on = 0x202cu;      /* UE, RXNEIE, TE, RE */

static volatile uint8_t ring[RING_SIZE];
static volatile uint16_t
  ring_put; /* by the interrupt alone; the positions run on, their difference is what the ring holds */
static volatile uint16_t ring_taken;

void usart2_interrupt(void);

void usart2_interrupt(void)
{
  const uint16_t put = ring_put;

  if ((PORT_CORTEX_M_REGISTER(USART2_SR) & status_receive) != 0u) {
    const uint8_t byte = (uint8_t)(PORT_CORTEX_M_REGISTER(USART2_DR) & 0xffu);

    if ((uint16_t)(put - ring_taken) < RING_SIZE) { /* else it is lost, and the frame is sent again */
      ring[put % RING_SIZE] = byte;
      ring_put = (uint16_t)(put + 1u);
    }
  } else {
    (void)PORT_CORTEX_M_REGISTER(USART2_DR); /* an overrun: status and then data end its interrupt */
  }
}

bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  const uint32_t clock_hz = PORT_BOARD_TICKS_PER_MS * 1000u;

  (void)device; /* there is one */
  serial->handle = 0;
  PORT_CORTEX_M_REGISTER(RCC_AHB1ENR) |= clock_gpioa;
  PORT_CORTEX_M_REGISTER(RCC_APB1ENR) |= clock_usart2;
  PORT_CORTEX_M_REGISTER(GPIOA_AFRL) =
    (PORT_CORTEX_M_REGISTER(GPIOA_AFRL) & ~pa2_pa3_function) | pa2_pa3_usart2;
  PORT_CORTEX_M_REGISTER(GPIOA_MODER) =
    (PORT_CORTEX_M_REGISTER(GPIOA_MODER) & ~pa2_pa3_mode) | pa2_pa3_alternate;
  PORT_CORTEX_M_REGISTER(USART2_BRR) = (clock_hz + baud / 2u) / baud;
  PORT_CORTEX_M_REGISTER(USART2_CR1) = control_on;
  port_cortex_m_interrupt_enable(USART2_IRQ);
  return true;
}

void port_serial_close(port_serial_t * serial)
{
  (void)serial;
  PORT_CORTEX_M_REGISTER(USART2_CR1) = 0;
}

static bool serial_put(uint8_t byte)
{
  const uint32_t start = port_time_ms();

  while ((PORT_CORTEX_M_REGISTER(USART2_SR) & status_transmit) == 0u) {
    if (port_time_ms() - start > BYTE_TIMEOUT_MS) {
      return false;
    }
  }
  PORT_CORTEX_M_REGISTER(USART2_DR) = byte;
  return true;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  bool taken = true;

  (void)serial;
  for (size_t i = 0; i < size && taken; ++i) {
    taken = serial_put(data[i]);
  }
  return taken;
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  uint16_t taken = ring_taken;
  size_t count = 0;

  (void)serial;
  while (count < capacity && taken != ring_put) {
    buffer[count] = ring[taken % RING_SIZE];
    taken = (uint16_t)(taken + 1u);
    ++count;
  }
  ring_taken = taken;
  return count;
}

int main(void)
{
  counter_run();
  return 0; /* the start-up code restarts the board after a second */
}
