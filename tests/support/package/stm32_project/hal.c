/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The functions of the HAL over a terminal, STM32_LINE. A thread is hardware and interrupts: it moves bytes one at a time.
 * After STM32_ERROR_EVERY received bytes one is lost and reception stops, as the HAL does at an error of the line.
 */
#define _DEFAULT_SOURCE
#include "main.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

/* usb.c and lwip_sockets.c have other hardware. */
#define WEAK __attribute__((weak))

static volatile uint32_t left_in_ring;
static DMA_HandleTypeDef dma = {&left_in_ring};
UART_HandleTypeDef huart1 = {HAL_UART_STATE_READY, HAL_UART_STATE_READY, &dma};

static pthread_mutex_t hardware;
static int line = -1;
static uint8_t * ring;
static uint16_t ring_size;
static uint8_t * single;
static const uint8_t * volatile sending;
static volatile uint16_t sending_size;
static long error_every;
static long received;

WEAK void HAL_UART_RxCpltCallback(UART_HandleTypeDef * uart)
{
  (void)uart;
}

static void move_in(uint8_t byte)
{
  ++received;
  if (error_every > 0 && received % error_every == 0) {
    huart1.RxState = HAL_UART_STATE_READY;
    ring = NULL;
    single = NULL;
  } else if (ring != NULL) {
    ring[ring_size - left_in_ring] = byte;
    left_in_ring = left_in_ring == 1u ? ring_size : left_in_ring - 1u;
  } else if (single != NULL) {
    *single = byte;
    single = NULL;
    huart1.RxState = HAL_UART_STATE_READY;
    HAL_UART_RxCpltCallback(&huart1);
  }
}

static void * hardware_run(void * nothing)
{
  for (;;) {
    struct pollfd waiting = {line, POLLIN, 0};
    uint8_t byte;

    if (poll(&waiting, 1, 1) > 0 && read(line, &byte, 1) == 1) {
      pthread_mutex_lock(&hardware);
      move_in(byte);
      pthread_mutex_unlock(&hardware);
    }
    if (huart1.gState != HAL_UART_STATE_READY) {
      if (write(line, (const void *)sending, sending_size) < 0) {
        return nothing;
      }
      huart1.gState = HAL_UART_STATE_READY;
    }
  }
}

WEAK void hal_begin(void)
{
  const char * every = getenv("STM32_ERROR_EVERY");
  struct termios settings;
  pthread_mutexattr_t kind;
  pthread_t thread;

  error_every = every != NULL ? atol(every) : 0;
  line = open(getenv("STM32_LINE"), O_RDWR | O_NOCTTY);
  if (line < 0 || tcgetattr(line, &settings) != 0) {
    exit(1);
  }
  cfmakeraw(&settings);
  (void)tcsetattr(line, TCSANOW, &settings);
  pthread_mutexattr_init(&kind);
  pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE);
  pthread_mutex_init(&hardware, &kind);
  (void)pthread_create(&thread, NULL, hardware_run, NULL);
}

static HAL_StatusTypeDef receive(UART_HandleTypeDef * uart, uint8_t * data, uint16_t size, bool is_circular)
{
  HAL_StatusTypeDef result = HAL_BUSY;

  pthread_mutex_lock(&hardware);
  if (uart->RxState == HAL_UART_STATE_READY) {
    uart->RxState = 0x22u;
    ring = is_circular ? data : NULL;
    single = is_circular ? NULL : data;
    ring_size = size;
    left_in_ring = size;
    result = HAL_OK;
  }
  pthread_mutex_unlock(&hardware);
  return result;
}

HAL_StatusTypeDef HAL_UART_Receive_DMA(UART_HandleTypeDef * uart, uint8_t * data, uint16_t size)
{
  return receive(uart, data, size, true);
}

HAL_StatusTypeDef HAL_UART_Receive_IT(UART_HandleTypeDef * uart, uint8_t * data, uint16_t size)
{
  return receive(uart, data, size, false);
}

static HAL_StatusTypeDef transmit(UART_HandleTypeDef * uart, const uint8_t * data, uint16_t size)
{
  if (uart->gState != HAL_UART_STATE_READY) {
    return HAL_BUSY;
  }
  sending = data;
  sending_size = size;
  uart->gState = 0x21u;
  return HAL_OK;
}

HAL_StatusTypeDef HAL_UART_Transmit_DMA(UART_HandleTypeDef * uart, const uint8_t * data, uint16_t size)
{
  return transmit(uart, data, size);
}

HAL_StatusTypeDef HAL_UART_Transmit_IT(UART_HandleTypeDef * uart, const uint8_t * data, uint16_t size)
{
  return transmit(uart, data, size);
}

HAL_StatusTypeDef HAL_UART_DMAStop(UART_HandleTypeDef * uart)
{
  return HAL_UART_Abort(uart);
}

HAL_StatusTypeDef HAL_UART_Abort(UART_HandleTypeDef * uart)
{
  pthread_mutex_lock(&hardware);
  ring = NULL;
  single = NULL;
  uart->RxState = HAL_UART_STATE_READY;
  pthread_mutex_unlock(&hardware);
  return HAL_OK;
}

uint32_t HAL_GetTick(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (uint32_t)(now.tv_sec * 1000 + now.tv_nsec / 1000000);
}

uint32_t HAL_GetUIDw0(void)
{
  return 0x00340021u;
}

uint32_t HAL_GetUIDw1(void)
{
  return 0x31385106u;
}

uint32_t HAL_GetUIDw2(void)
{
  return (uint32_t)getpid();
}

WEAK void __disable_irq(void)
{
  pthread_mutex_lock(&hardware);
}

uint32_t __get_PRIMASK(void)
{
  return 0;
}

WEAK void __set_PRIMASK(uint32_t mask)
{
  (void)mask;
  pthread_mutex_unlock(&hardware);
}

void __WFI(void)
{
  (void)usleep(1000);
}
