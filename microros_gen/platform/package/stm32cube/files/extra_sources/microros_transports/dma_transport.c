/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A UART with DMA: circular for what arrives, so that no interrupt is needed for a byte; what is sent is copied, so that a
 * write does not wait for the line. A Cortex-M7 with data cache: the buffers share no cache line.
 */
#include "cubemx_transport.h"

#if !defined(MICROROS_TRANSPORT) || MICROROS_TRANSPORT == MICROROS_TRANSPORT_DMA

#include "../microros_hal.h"

#include <string.h>

enum { CACHE_LINE = 32 };

static uint8_t rx[MICROROS_RX_SIZE] __attribute__((aligned(CACHE_LINE))) MICROROS_DMA_MEMORY;
static uint8_t tx[MICROROS_TX_SIZE] __attribute__((aligned(CACHE_LINE))) MICROROS_DMA_MEMORY;
static size_t rx_first; /* position of the next byte to read */

static void cache_clean(void)
{
#if defined(__DCACHE_PRESENT) && (__DCACHE_PRESENT == 1U)
  if ((SCB->CCR & SCB_CCR_DC_Msk) != 0u) {
    SCB_CleanDCache_by_Addr((uint32_t *)(void *)tx, (int32_t)sizeof(tx));
  }
#endif
}

static void cache_invalidate(void)
{
#if defined(__DCACHE_PRESENT) && (__DCACHE_PRESENT == 1U)
  if ((SCB->CCR & SCB_CCR_DC_Msk) != 0u) {
    SCB_InvalidateDCache_by_Addr((uint32_t *)(void *)rx, (int32_t)sizeof(rx));
  }
#endif
}

/* The HAL stops reception at an error of the line (noise, framing, overrun): begins again then, with an empty buffer. */
static bool reception_ensure(UART_HandleTypeDef * uart)
{
  if (uart->RxState == HAL_UART_STATE_READY) {
    rx_first = 0;
    cache_invalidate(); /* a line that is written back later would replace what the DMA wrote */
    return HAL_UART_Receive_DMA(uart, rx, MICROROS_RX_SIZE) == HAL_OK;
  }
  return true;
}

/* Called again after each outage of the agent. */
bool cubemx_transport_open(struct uxrCustomTransport * transport)
{
  return reception_ensure((UART_HandleTypeDef *)transport->args);
}

bool cubemx_transport_close(struct uxrCustomTransport * transport)
{
  UART_HandleTypeDef * uart = (UART_HandleTypeDef *)transport->args;
  const uint32_t start_ms = HAL_GetTick();

  while (uart->gState != HAL_UART_STATE_READY && (HAL_GetTick() - start_ms) < MICROROS_WRITE_TIMEOUT_MS) {
    cubemx_rest();
  }
  return HAL_UART_DMAStop(uart) == HAL_OK;
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
  cache_clean();
  if (HAL_UART_Transmit_DMA(uart, tx, (uint16_t)size) != HAL_OK) {
    *err = 1;
    return 0;
  }
  return size;
}

/* Returns the position that the DMA writes next. */
static size_t rx_end(const UART_HandleTypeDef * uart)
{
  return ((size_t)MICROROS_RX_SIZE - (size_t)__HAL_DMA_GET_COUNTER(uart->hdmarx)) % MICROROS_RX_SIZE;
}

size_t cubemx_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  UART_HandleTypeDef * uart = (UART_HandleTypeDef *)transport->args;
  const uint32_t start_ms = HAL_GetTick();
  size_t count = 0;
  size_t end;

  if (!reception_ensure(uart)) {
    *err = 1;
    return 0;
  }
  end = rx_end(uart);
  while (end == rx_first) {
    if (!cubemx_rest_until(start_ms, timeout)) {
      return 0;
    }
    end = rx_end(uart);
  }
  cache_invalidate();
  while (count < len && rx_first != end) {
    buf[count] = rx[rx_first];
    ++count;
    rx_first = (rx_first + 1u) % MICROROS_RX_SIZE;
  }
  return count;
}

#endif
