/* SPDX-License-Identifier: Apache-2.0 */
/* it_transport.c over a HAL whose calls lock the UART, as those of several families do. One byte waits in the hardware. */
#include "cubemx_transport.h"
#include "main.h"

#include <stdio.h>

static UART_HandleTypeDef uart = {HAL_UART_STATE_READY, HAL_UART_STATE_READY, NULL};
static uint8_t * target;
static bool is_locked;
static bool is_masked;
static int waiting = -1;
static char during_transmit;
static uint32_t now_ms;
static int lost;

static void interrupt(void)
{
  if (waiting >= 0 && !is_masked && uart.RxState != HAL_UART_STATE_READY) {
    *target = (uint8_t)waiting;
    waiting = -1;
    uart.RxState = HAL_UART_STATE_READY;
    HAL_UART_RxCpltCallback(&uart);
  }
}

static void arrive(char byte)
{
  lost += waiting >= 0;
  waiting = byte;
  interrupt();
}

void __disable_irq(void)
{
  is_masked = true;
}

uint32_t __get_PRIMASK(void)
{
  return is_masked;
}

void __set_PRIMASK(uint32_t mask)
{
  is_masked = mask != 0u;
  interrupt();
}

HAL_StatusTypeDef HAL_UART_Receive_IT(UART_HandleTypeDef * line, uint8_t * data, uint16_t size)
{
  (void)size;
  if (is_locked || line->RxState != HAL_UART_STATE_READY) {
    return HAL_BUSY;
  }
  target = data;
  line->RxState = 0x22u;
  interrupt();
  return HAL_OK;
}

HAL_StatusTypeDef HAL_UART_Transmit_IT(UART_HandleTypeDef * line, const uint8_t * data, uint16_t size)
{
  (void)line;
  (void)data;
  (void)size;
  is_locked = true;
  arrive(during_transmit);
  is_locked = false;
  return HAL_OK;
}

HAL_StatusTypeDef HAL_UART_Abort(UART_HandleTypeDef * line)
{
  line->RxState = HAL_UART_STATE_READY;
  return HAL_OK;
}

uint32_t HAL_GetTick(void)
{
  return now_ms;
}

void cubemx_rest(void)
{
  ++now_ms;
}

/* In the wait from 1000 ms on: an overrun, then bytes. */
bool cubemx_rest_until(uint32_t start_ms, int timeout_ms)
{
  if (now_ms - start_ms >= (uint32_t)timeout_ms) {
    return false;
  }
  ++now_ms;
  if (now_ms == 1001u) {
    uart.RxState = HAL_UART_STATE_READY;
  } else if (now_ms == 1003u) {
    arrive('h');
    arrive('i');
  }
  return true;
}

static void read_all(struct uxrCustomTransport * transport, int timeout_ms)
{
  uint8_t bytes[16];
  uint8_t err = 0;
  const size_t count = cubemx_transport_read(transport, bytes, sizeof(bytes), timeout_ms, &err);

  (void)printf(
    "%.*s lost %d err %d at %u\n", (int)count, (const char *)bytes, lost, err, (unsigned int)now_ms);
}

int main(void)
{
  static struct uxrCustomTransport transport;
  uint8_t err = 0;

  transport.args = &uart;
  if (!cubemx_transport_open(&transport)) {
    return 1;
  }
  during_transmit = 'a';
  if (cubemx_transport_write(&transport, (const uint8_t *)"x", 1, &err) != 1u) {
    return 2;
  }
  arrive('b');
  arrive('c');
  read_all(&transport, 0);
  is_locked = true; /* by a call of the application */
  arrive('d');
  is_locked = false;
  read_all(&transport, 0);
  arrive('e');
  read_all(&transport, 0);
  now_ms = 1000;
  read_all(&transport, 50);
  return 0;
}
