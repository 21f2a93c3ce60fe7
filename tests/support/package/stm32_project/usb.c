/* SPDX-License-Identifier: Apache-2.0 */
/*
 * STM32Cube's USB device over a terminal, STM32_LINE. A thread is the interrupt of USB: it moves packets in both
 * directions. When the terminal is gone the cable is pulled: nothing completes until there is one again, which configures
 * the device again (USBD_CDC_Init: no transfer is in progress, and one packet is asked for).
 */
#define _DEFAULT_SOURCE
#include "main.h"

#include "usbd_cdc_if.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

USBD_HandleTypeDef hUsbDeviceFS;
USBD_CDC_ItfTypeDef USBD_Interface_fops_FS;

static uint8_t user_buffer[64];
static pthread_mutex_t interrupt;
static int line = -1;
static bool is_armed;
static uint8_t * target;
static const uint8_t * sending;
static size_t sending_size;

static void configure(void)
{
  struct termios settings;

  line = open(getenv("STM32_LINE"), O_RDWR | O_NOCTTY);
  if (line >= 0 && tcgetattr(line, &settings) == 0) {
    cfmakeraw(&settings);
    (void)tcsetattr(line, TCSANOW, &settings);
    sending = NULL;
    target = user_buffer;
    is_armed = true;
    hUsbDeviceFS.dev_state = USBD_STATE_CONFIGURED;
  } else {
    (void)usleep(10000);
  }
}

static void pull(void)
{
  (void)close(line);
  line = -1;
  hUsbDeviceFS.dev_state = USBD_STATE_DEFAULT;
}

/* Returns false when the other side is gone. */
static bool move_in(void)
{
  const ssize_t count = read(line, target, sizeof(user_buffer));
  uint32_t size = (uint32_t)count;

  if (count <= 0) {
    return false;
  }
  is_armed = false;
  if (USBD_Interface_fops_FS.Receive != NULL) {
    (void)USBD_Interface_fops_FS.Receive(target, &size);
  }
  return true;
}

static bool move_out(void)
{
  const ssize_t count = write(line, sending, sending_size);

  if (count < 0) {
    return false;
  }
  sending += count;
  sending_size -= (size_t)count;
  if (sending_size == 0u) {
    sending = NULL;
  }
  return true;
}

static void * device_run(void * nothing)
{
  for (;;) {
    struct pollfd waiting = {line, POLLIN, 0};
    bool is_there = true;

    (void)poll(&waiting, line >= 0 ? 1u : 0u, 1);
    pthread_mutex_lock(&interrupt);
    if (line < 0) {
      configure();
    } else {
      if ((waiting.revents & POLLIN) != 0 && is_armed) {
        is_there = move_in();
      } else if ((waiting.revents & POLLHUP) != 0) {
        is_there = false;
      }
      if (is_there && sending != NULL) {
        is_there = move_out();
      }
      if (!is_there) {
        pull();
      }
    }
    pthread_mutex_unlock(&interrupt);
  }
  return nothing;
}

void hal_begin(void)
{
  pthread_mutexattr_t kind;
  pthread_t thread;

  pthread_mutexattr_init(&kind);
  pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE);
  pthread_mutex_init(&interrupt, &kind);
  (void)pthread_create(&thread, NULL, device_run, NULL);
}

uint8_t CDC_Transmit_FS(uint8_t * data, uint16_t size)
{
  uint8_t result = USBD_BUSY;

  pthread_mutex_lock(&interrupt);
  if (sending == NULL) {
    sending = data;
    sending_size = size;
    result = USBD_OK;
  }
  pthread_mutex_unlock(&interrupt);
  return result;
}

uint8_t USBD_CDC_SetRxBuffer(USBD_HandleTypeDef * device, uint8_t * data)
{
  (void)device;
  target = data;
  return USBD_OK;
}

uint8_t USBD_CDC_ReceivePacket(USBD_HandleTypeDef * device)
{
  (void)device;
  is_armed = true;
  return USBD_OK;
}

void __disable_irq(void)
{
  pthread_mutex_lock(&interrupt);
}

void __set_PRIMASK(uint32_t mask)
{
  (void)mask;
  pthread_mutex_unlock(&interrupt);
}
