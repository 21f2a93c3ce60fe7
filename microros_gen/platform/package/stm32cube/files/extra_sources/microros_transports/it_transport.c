/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A UART with an interrupt for each byte. What is sent is copied, so that a write does not wait for the line.
 *
 * This file has HAL_UART_RxCpltCallback. A project that has its own defines MICROROS_UART_CALLBACK as 0 and calls
 * cubemx_transport_received(huart) there.
 */
#include "cubemx_transport.h"

#if !defined(MICROROS_TRANSPORT) || MICROROS_TRANSPORT == MICROROS_TRANSPORT_IT

#include "../microros_hal.h"

#include <string.h>

#ifndef MICROROS_UART_CALLBACK
#define MICROROS_UART_CALLBACK 1
#endif

void cubemx_transport_received(UART_HandleTypeDef * uart);

static uint8_t rx[MICROROS_RX_SIZE];
static uint8_t tx[MICROROS_TX_SIZE];
static uint8_t arriving;
static volatile size_t rx_first; /* position of the next byte to read; only the reader changes it */
static volatile size_t rx_end;   /* position after the last one; only the interrupt changes it */
static UART_HandleTypeDef * volatile line;

/* Does nothing for another UART. A byte without room is lost: the frame that it belongs to is repeated or dropped. */
void cubemx_transport_received(UART_HandleTypeDef * uart)
{
  const size_t end = rx_end;
  const size_t next = (end + 1u) % MICROROS_RX_SIZE;

  if (uart != line) {
    return;
  }
  if (next != rx_first) {
    rx[end] = arriving;
    rx_end = next;
  }
  (void)HAL_UART_Receive_IT(uart, &arriving, 1); /* refused: a read begins again */
}

#if MICROROS_UART_CALLBACK
void HAL_UART_RxCpltCallback(UART_HandleTypeDef * huart)
{
  cubemx_transport_received(huart);
}
#endif

/* The HAL stops reception at an overrun, and refuses it while another call has locked the UART: begins again then. */
static bool reception_ensure(UART_HandleTypeDef * uart)
{
  return uart->RxState != HAL_UART_STATE_READY || HAL_UART_Receive_IT(uart, &arriving, 1) != HAL_ERROR;
}

/* Called again after each outage of the agent. */
bool cubemx_transport_open(struct uxrCustomTransport * transport)
{
  line = (UART_HandleTypeDef *)transport->args;
  return reception_ensure(line);
}

bool cubemx_transport_close(struct uxrCustomTransport * transport)
{
  UART_HandleTypeDef * uart = (UART_HandleTypeDef *)transport->args;
  const uint32_t start_ms = HAL_GetTick();

  while (uart->gState != HAL_UART_STATE_READY && (HAL_GetTick() - start_ms) < MICROROS_WRITE_TIMEOUT_MS) {
    cubemx_rest();
  }
  return HAL_UART_Abort(uart) == HAL_OK;
}

/* An interrupt in the middle would find the UART locked, and could not begin the reception of the next byte. */
static HAL_StatusTypeDef transmission_begin(UART_HandleTypeDef * uart, size_t size)
{
  const uint32_t mask = __get_PRIMASK();
  HAL_StatusTypeDef result;

  __disable_irq();
  result = HAL_UART_Transmit_IT(uart, tx, (uint16_t)size);
  __set_PRIMASK(mask);
  return result;
}

/* Waits only until the bytes of the previous write are sent. */
size_t cubemx_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  UART_HandleTypeDef * uart = (UART_HandleTypeDef *)transport->args;
  const uint32_t start_ms = HAL_GetTick();
  const size_t size = len < sizeof(tx) ? len : sizeof(tx);

  while (uart->gState != HAL_UART_STATE_READY) {
    if ((HAL_GetTick() - start_ms) >= MICROROS_WRITE_TIMEOUT_MS) {
      *err = 1;
      return 0;
    }
    cubemx_rest();
  }
  (void)memcpy(tx, buf, size);
  if (transmission_begin(uart, size) != HAL_OK) {
    *err = 1;
    return 0;
  }
  return size;
}

size_t cubemx_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  UART_HandleTypeDef * uart = (UART_HandleTypeDef *)transport->args;
  const uint32_t start_ms = HAL_GetTick();
  bool is_receiving = reception_ensure(uart);
  size_t count = 0;

  while (is_receiving && rx_end == rx_first) {
    if (!cubemx_rest_until(start_ms, timeout)) {
      return 0;
    }
    is_receiving = reception_ensure(uart);
  }
  if (!is_receiving) {
    *err = 1;
    return 0;
  }
  while (count < len && rx_end != rx_first) {
    buf[count] = rx[rx_first];
    ++count;
    rx_first = (rx_first + 1u) % MICROROS_RX_SIZE;
  }
  return count;
}

#endif
