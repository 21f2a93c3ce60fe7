/* SPDX-License-Identifier: Apache-2.0 */
#include "esp32_serial_transport.h"

#include "sdkconfig.h"

#include "driver/uart.h"
#include "freertos/FreeRTOS.h"

/* The driver's rings. What is received between two calls of the library has to fit; 2 KiB are 180 ms at 115,200 baud. */
enum { RECEIVED = 2048, OUTPUT = 1024 };

/* The line stops the sender while this many bytes of the hardware's 128 wait. */
enum { FLOW_LIMIT = 100 };

#if CONFIG_MICROROS_UART_RTS >= 0 && CONFIG_MICROROS_UART_CTS >= 0
#define FLOW UART_HW_FLOWCTRL_CTS_RTS
#elif CONFIG_MICROROS_UART_RTS >= 0
#define FLOW UART_HW_FLOWCTRL_RTS
#elif CONFIG_MICROROS_UART_CTS >= 0
#define FLOW UART_HW_FLOWCTRL_CTS
#else
#define FLOW UART_HW_FLOWCTRL_DISABLE
#endif

static uart_port_t port_of(const struct uxrCustomTransport * transport)
{
  return (uart_port_t) * (const size_t *)transport->args;
}

bool esp32_serial_open(struct uxrCustomTransport * transport)
{
  const uart_port_t port = port_of(transport);
  const uart_config_t settings = {
    .baud_rate = CONFIG_MICROROS_UART_BAUD,
    .data_bits = UART_DATA_8_BITS,
    .parity = UART_PARITY_DISABLE,
    .stop_bits = UART_STOP_BITS_1,
    .flow_ctrl = FLOW,
    .rx_flow_ctrl_thresh = (uint8_t)FLOW_LIMIT,
    .source_clk = UART_SCLK_DEFAULT};

  return uart_driver_install(port, RECEIVED, OUTPUT, 0, NULL, 0) == ESP_OK &&
         uart_param_config(port, &settings) == ESP_OK &&
         uart_set_pin(
           port, CONFIG_MICROROS_UART_TXD, CONFIG_MICROROS_UART_RXD, CONFIG_MICROROS_UART_RTS,
           CONFIG_MICROROS_UART_CTS) == ESP_OK;
}

bool esp32_serial_close(struct uxrCustomTransport * transport)
{
  return uart_driver_delete(port_of(transport)) == ESP_OK;
}

/* Waits for room in the driver's ring if a message is larger. */
size_t esp32_serial_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const int sent = uart_write_bytes(port_of(transport), buf, len);

  *err = sent < 0 ? 1u : 0u;
  return sent < 0 ? 0u : (size_t)sent;
}

/* The driver would wait until all `len` bytes have arrived: so wait for the first one only. */
size_t esp32_serial_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  const uart_port_t port = port_of(transport);
  const TickType_t ticks = pdMS_TO_TICKS((TickType_t)timeout);
  size_t waiting = 0;
  int first;
  int rest = 0;

  *err = 0;
  if (len == 0u) {
    return 0;
  }
  first = uart_read_bytes(port, buf, 1u, timeout > 0 && ticks == 0u ? 1u : ticks);
  if (first == 1 && uart_get_buffered_data_len(port, &waiting) == ESP_OK && waiting != 0u) {
    rest = uart_read_bytes(port, &buf[1], (uint32_t)(waiting < len - 1u ? waiting : len - 1u), 0);
  }
  if (first < 0 || rest < 0) {
    *err = 1;
    return 0;
  }
  return (size_t)(first + rest);
}
