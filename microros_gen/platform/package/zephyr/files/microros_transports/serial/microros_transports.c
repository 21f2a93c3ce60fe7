/* SPDX-License-Identifier: Apache-2.0 */
/* Received bytes and bytes to send wait in rings of the kernel, which one side writes and the other one reads. */
#include "microros_transports.h"

#include <zephyr/devicetree.h>
#include <zephyr/drivers/uart.h>
#include <zephyr/kernel.h>
#include <zephyr/sys/ring_buffer.h>

#if !defined(CONFIG_UART_INTERRUPT_DRIVEN)
#error "prj.conf: set CONFIG_SERIAL=y and CONFIG_UART_INTERRUPT_DRIVEN=y"
#endif

/* What is received between two calls of the library has to fit; 2 KiB are 180 ms at 115,200 baud. */
enum { RECEIVED = 2048, OUTPUT = 1024, PART = 16 };

#if DT_NODE_EXISTS(DT_ALIAS(microros_uart))
zephyr_transport_params_t default_params = {.uart_dev = DEVICE_DT_GET(DT_ALIAS(microros_uart))};
#else
zephyr_transport_params_t default_params; /* the program names the device */
#endif

static uint8_t received_bytes[RECEIVED];
static uint8_t output_bytes[OUTPUT];
static struct ring_buf received;
static struct ring_buf output;
static K_SEM_DEFINE(arrived, 0, 1);
static K_SEM_DEFINE(sent, 0, 1);

static const struct device * device_of(const struct uxrCustomTransport * transport)
{
  return ((const zephyr_transport_params_t *)transport->args)->uart_dev;
}

/* In the interrupt. The library sends again what finds no room. */
static void line_receive(const struct device * device)
{
  uint8_t bytes[PART];
  int size = uart_fifo_read(device, bytes, (int)sizeof(bytes));

  while (size > 0) {
    (void)ring_buf_put(&received, bytes, (uint32_t)size);
    size = uart_fifo_read(device, bytes, (int)sizeof(bytes));
  }
  k_sem_give(&arrived);
}

/* In the interrupt: fills the device as far as it has room. */
static void line_send(const struct device * device)
{
  uint8_t * bytes = NULL;
  const uint32_t size = ring_buf_get_claim(&output, &bytes, (uint32_t)OUTPUT);
  int taken = 0;

  if (size == 0u) {
    uart_irq_tx_disable(device);
  } else {
    taken = uart_fifo_fill(device, bytes, (int)size);
  }
  (void)ring_buf_get_finish(&output, taken > 0 ? (uint32_t)taken : 0u);
  if (size == 0u && !ring_buf_is_empty(&output)) {
    uart_irq_tx_enable(device); /* a task on another processor has written meanwhile */
  }
  k_sem_give(&sent);
}

static void line_interrupt(const struct device * device, void * context)
{
  (void)context;
  while (uart_irq_update(device) > 0 && uart_irq_is_pending(device) > 0) {
    if (uart_irq_rx_ready(device) > 0) {
      line_receive(device);
    }
    if (uart_irq_tx_ready(device) > 0) {
      line_send(device);
    }
  }
}

/* Called again after each outage of the agent. */
bool zephyr_transport_open(struct uxrCustomTransport * transport)
{
  const struct device * device = device_of(transport);

  if (device == NULL || !device_is_ready(device)) {
    return false;
  }
  ring_buf_init(&received, (uint32_t)sizeof(received_bytes), received_bytes);
  ring_buf_init(&output, (uint32_t)sizeof(output_bytes), output_bytes);
  if (uart_irq_callback_user_data_set(device, line_interrupt, NULL) != 0) {
    return false;
  }
  uart_irq_rx_enable(device);
  return true;
}

bool zephyr_transport_close(struct uxrCustomTransport * transport)
{
  uart_irq_rx_disable(device_of(transport));
  uart_irq_tx_disable(device_of(transport));
  return true;
}

/* Waits while the ring is full, at most as long as 1 KiB takes at 9600 baud: without a computer at a USB port, nothing leaves. */
size_t zephyr_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const struct device * device = device_of(transport);
  size_t count = 0;
  bool is_stuck = false;

  while (count < len && !is_stuck) {
    count += ring_buf_put(&output, &buf[count], (uint32_t)(len - count));
    uart_irq_tx_enable(device);
    is_stuck = count < len && k_sem_take(&sent, K_MSEC(1100)) != 0;
  }
  *err = is_stuck ? 1u : 0u;
  return count;
}

size_t zephyr_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  const uint32_t most = len < (size_t)RECEIVED ? (uint32_t)len : (uint32_t)RECEIVED;
  uint32_t count = ring_buf_get(&received, buf, most);

  (void)transport;
  *err = 0;
  if (count == 0u && timeout > 0) {
    k_sem_reset(&arrived);
    count = ring_buf_get(&received, buf, most); /* what arrived before the reset */
    if (count == 0u && k_sem_take(&arrived, K_MSEC(timeout)) == 0) {
      count = ring_buf_get(&received, buf, most);
    }
  }
  return count;
}
