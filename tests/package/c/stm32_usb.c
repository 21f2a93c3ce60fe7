/* SPDX-License-Identifier: Apache-2.0 */
/* usb_cdc_transport.c over a device that reads the bytes of a transfer when it completes. */
#include "cubemx_transport.h"
#include "main.h"

#include "usbd_cdc_if.h"

#include <stdio.h>
#include <string.h>

USBD_HandleTypeDef hUsbDeviceFS;
USBD_CDC_ItfTypeDef USBD_Interface_fops_FS;

static bool is_armed;
static const uint8_t * in_flight;
static uint16_t in_flight_size;
static uint32_t now_ms;
static uint32_t completes_at_ms;

static void complete(void)
{
  (void)printf("sent %.*s\n", (int)in_flight_size, (const char *)in_flight);
  in_flight = NULL;
  if (USBD_Interface_fops_FS.TransmitCplt != NULL) {
    uint32_t size = in_flight_size;

    (void)USBD_Interface_fops_FS.TransmitCplt(NULL, &size, 1);
  }
}

/* As the generated one, it must not be called before the device is configured. */
uint8_t CDC_Transmit_FS(uint8_t * data, uint16_t size)
{
  if (hUsbDeviceFS.dev_state != USBD_STATE_CONFIGURED) {
    (void)printf("null pointer\n");
  }
  if (in_flight != NULL) {
    return USBD_BUSY;
  }
  in_flight = data;
  in_flight_size = size;
  return USBD_OK;
}

uint8_t USBD_CDC_SetRxBuffer(USBD_HandleTypeDef * device, uint8_t * data)
{
  (void)device;
  (void)data;
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
}

uint32_t __get_PRIMASK(void)
{
  return 0;
}

void __set_PRIMASK(uint32_t mask)
{
  (void)mask;
}

uint32_t HAL_GetTick(void)
{
  return now_ms;
}

void cubemx_rest(void)
{
  ++now_ms;
  if (now_ms == completes_at_ms) {
    complete();
  }
}

bool cubemx_rest_until(uint32_t start_ms, int timeout_ms)
{
  (void)start_ms;
  (void)timeout_ms;
  return false;
}

static void write_one(struct uxrCustomTransport * transport, const char * text)
{
  const uint32_t before = now_ms;
  uint8_t err = 0;
  const size_t size = cubemx_transport_write(transport, (const uint8_t *)text, strlen(text), &err);

  (void)printf("%s %u err %d after %u\n", text, (unsigned int)size, err, (unsigned int)(now_ms - before));
}

/* A packet of the computer, if the device takes one. */
static bool packet(uint8_t first)
{
  uint8_t bytes[64];
  uint32_t size = sizeof(bytes);

  if (!is_armed) {
    return false;
  }
  is_armed = false;
  for (size_t i = 0; i < sizeof(bytes); ++i) {
    bytes[i] = (uint8_t)(first + i);
  }
  (void)USBD_Interface_fops_FS.Receive(bytes, &size);
  return true;
}

/* Reads all bytes; they count up from 0, without a gap. */
static void read_all(struct uxrCustomTransport * transport)
{
  uint8_t bytes[100];
  uint8_t expected = 0;
  uint8_t err = 0;
  size_t count = 0;
  size_t size = cubemx_transport_read(transport, bytes, sizeof(bytes), 0, &err);

  while (size > 0u) {
    for (size_t i = 0; i < size; ++i) {
      if (bytes[i] != expected) {
        (void)printf("gap at %u\n", (unsigned int)count);
      }
      ++expected;
      ++count;
    }
    size = cubemx_transport_read(transport, bytes, sizeof(bytes), 0, &err);
  }
  (void)printf("read %u, armed %d\n", (unsigned int)count, (int)is_armed);
}

/* Packets until the device takes no more; then it is configured again, which lets it take one. */
static void receive(struct uxrCustomTransport * transport, bool is_configured_again)
{
  uint8_t packets = 0;

  while (packet((uint8_t)(packets * 64u))) {
    ++packets;
  }
  is_armed = is_configured_again;
  (void)printf("packets %d, then %d\n", (int)packets, (int)packet((uint8_t)(packets * 64u)));
  read_all(transport);
}

int main(void)
{
  static struct uxrCustomTransport transport;

  if (!cubemx_transport_open(&transport)) {
    return 1;
  }
  write_one(&transport, "early");
  hUsbDeviceFS.dev_state = USBD_STATE_CONFIGURED;
  is_armed = true;
  write_one(&transport, "first");
  write_one(&transport, "second");
  write_one(&transport, "third");
  complete();
  write_one(&transport, "fourth");
  completes_at_ms = now_ms + 7u;
  write_one(&transport, "fifth");
  complete();
  in_flight = (const uint8_t *)"gone"; /* the cable is pulled, then the device is configured again */
  write_one(&transport, "sixth");
  in_flight = NULL;
  write_one(&transport, "seventh");
  complete();
  receive(&transport, false);
  receive(&transport, true);
  return 0;
}
