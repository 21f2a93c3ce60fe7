/* SPDX-License-Identifier: Apache-2.0 */
/* A UART that takes a byte at a time: which of them end a wait. */
#include "unit.h"

#include <microros/port.h>
#include <microros_config.h>

#include <zephyr/device.h>
#include <zephyr/drivers/uart.h>
#include <zephyr/kernel.h>
#include <zephyr/sys/ring_buffer.h>

enum { BAUD = 115200 };

static const struct device uart = {"uart"};
static uart_irq_callback_user_data_t interrupt;
static void * context;
static bool sends;      /* the transmit interrupt is enabled */
static bool is_pending; /* of this call */
static uint32_t unsent; /* bytes of the ring of the output */
static uint32_t sent;   /* bytes, in all */
static unsigned wakes;
static uint32_t woken_at; /* the number of bytes that were sent before the last one */

void port_wake(void)
{
  ++wakes;
  woken_at = sent;
}

atomic_val_t atomic_get(const atomic_t * target)
{
  return *target;
}

atomic_val_t atomic_add(atomic_t * target, atomic_val_t value)
{
  *target += value;
  return *target - value;
}

const struct device * device_get_binding(const char * name)
{
  (void)name;
  return &uart;
}

bool device_is_ready(const struct device * device)
{
  return device == &uart;
}

int uart_configure(const struct device * device, const struct uart_config * config)
{
  (void)device, (void)config;
  return 0;
}

int uart_irq_callback_user_data_set(
  const struct device * device, uart_irq_callback_user_data_t callback, void * user_data)
{
  (void)device;
  interrupt = callback;
  context = user_data;
  return 0;
}

void uart_irq_rx_enable(const struct device * device)
{
  (void)device;
}

void uart_irq_rx_disable(const struct device * device)
{
  (void)device;
}

void uart_irq_tx_enable(const struct device * device)
{
  (void)device;
  sends = true;
}

void uart_irq_tx_disable(const struct device * device)
{
  (void)device;
  sends = false;
}

int uart_irq_update(const struct device * device)
{
  (void)device;
  return 1;
}

int uart_irq_is_pending(const struct device * device)
{
  const bool was_pending = is_pending;

  (void)device;
  is_pending = false;
  return was_pending ? 1 : 0;
}

int uart_irq_rx_ready(const struct device * device)
{
  (void)device;
  return 0;
}

int uart_irq_tx_ready(const struct device * device)
{
  (void)device;
  return 1;
}

int uart_fifo_read(const struct device * device, uint8_t * bytes, int size)
{
  (void)device, (void)bytes, (void)size;
  return 0;
}

int uart_fifo_fill(const struct device * device, const uint8_t * bytes, int size)
{
  (void)device, (void)bytes;
  CHECK(size > 0);
  return 1;
}

void ring_buf_init(struct ring_buf * ring, uint32_t size, uint8_t * bytes)
{
  ring->buffer = bytes;
  ring->size = size;
}

uint32_t ring_buf_put(struct ring_buf * ring, const uint8_t * bytes, uint32_t size)
{
  (void)bytes;
  CHECK(unsent + size <= ring->size);
  unsent += size;
  return size;
}

uint32_t ring_buf_get(struct ring_buf * ring, uint8_t * bytes, uint32_t size)
{
  (void)ring, (void)bytes, (void)size;
  return 0;
}

uint32_t ring_buf_get_claim(struct ring_buf * ring, uint8_t ** bytes, uint32_t size)
{
  *bytes = ring->buffer;
  return unsent < size ? unsent : size;
}

int ring_buf_get_finish(struct ring_buf * ring, uint32_t size)
{
  (void)ring;
  unsent -= size;
  sent += size;
  return 0;
}

uint32_t ring_buf_space_get(const struct ring_buf * ring)
{
  return ring->size - unsent;
}

bool ring_buf_is_empty(const struct ring_buf * ring)
{
  (void)ring;
  return unsent == 0u;
}

static void run_interrupt(void)
{
  is_pending = true;
  interrupt(&uart, context);
}

int main(void)
{
  static const uint8_t bytes[MICROROS_SEND_BUFFER];
  const uint32_t half = (uint32_t)(sizeof(bytes) - sizeof(bytes) / 2u);
  port_serial_t serial;

  CHECK(port_serial_open(&serial, "uart", BAUD));
  CHECK(port_serial_write(&serial, bytes, sizeof(bytes)) && sends);
  CHECK(port_serial_room(&serial) == 0u && !port_serial_write(&serial, bytes, 1));
  while (sends) {
    run_interrupt();
    CHECK(wakes == (sent < sizeof(bytes) / 2u ? 0u : sent < sizeof(bytes) ? 1u : 2u));
  }
  CHECK(wakes == 2u && sent == sizeof(bytes) && woken_at == sizeof(bytes));
  CHECK(port_serial_write(&serial, bytes, half) && sends); /* a frame of any size fits after one of them */
  while (sends) {
    run_interrupt();
  }
  CHECK(wakes >= 3u && woken_at == sizeof(bytes) + half);
  port_serial_close(&serial);
  return 0;
}
