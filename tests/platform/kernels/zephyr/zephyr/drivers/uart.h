/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_ZEPHYR_UART_H
#define STAND_IN_ZEPHYR_UART_H

#include "zephyr/device.h"

#include <stdint.h>

enum uart_config_parity { UART_CFG_PARITY_NONE };
enum uart_config_stop_bits { UART_CFG_STOP_BITS_1 = 1 };
enum uart_config_data_bits { UART_CFG_DATA_BITS_8 = 3 };
enum uart_config_flow_control { UART_CFG_FLOW_CTRL_NONE };

struct uart_config {
  uint32_t baudrate;
  uint8_t parity;
  uint8_t stop_bits;
  uint8_t data_bits;
  uint8_t flow_ctrl;
};

typedef void (*uart_irq_callback_user_data_t)(const struct device * device, void * user_data);

int uart_configure(const struct device * device, const struct uart_config * config);
int uart_irq_callback_user_data_set(
  const struct device * device, uart_irq_callback_user_data_t callback, void * user_data);
void uart_irq_rx_enable(const struct device * device);
void uart_irq_rx_disable(const struct device * device);
void uart_irq_tx_enable(const struct device * device);
void uart_irq_tx_disable(const struct device * device);
int uart_irq_update(const struct device * device);
int uart_irq_is_pending(const struct device * device);
int uart_irq_rx_ready(const struct device * device);
int uart_irq_tx_ready(const struct device * device);
int uart_fifo_read(const struct device * device, uint8_t * bytes, int size);
int uart_fifo_fill(const struct device * device, const uint8_t * bytes, int size);

#endif /* STAND_IN_ZEPHYR_UART_H */
