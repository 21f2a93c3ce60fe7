/* SPDX-License-Identifier: Apache-2.0 */
/*
 * USB CDC, "Virtual Port Com" of STM32CubeMX at the full-speed connector; MICROROS_USB_HS: at the high-speed one. Replaces
 * the function Receive of the generated usbd_cdc_if.c. What has no room is not accepted from the computer, which repeats
 * it: nothing is lost.
 */
#include "cubemx_transport.h"

#if !defined(MICROROS_TRANSPORT) || MICROROS_TRANSPORT == MICROROS_TRANSPORT_USB_CDC

#include "../microros_hal.h"

#include "usbd_cdc.h"
#include "usbd_cdc_if.h"

#include <string.h>

#if defined(MICROROS_USB_HS)
#define USB_DEVICE hUsbDeviceHS
#define USB_FUNCTIONS USBD_Interface_fops_HS
#define USB_TRANSMIT CDC_Transmit_HS
#define USB_PACKET CDC_DATA_HS_MAX_PACKET_SIZE
#else
#define USB_DEVICE hUsbDeviceFS
#define USB_FUNCTIONS USBD_Interface_fops_FS
#define USB_TRANSMIT CDC_Transmit_FS
#define USB_PACKET CDC_DATA_FS_MAX_PACKET_SIZE
#endif

extern USBD_HandleTypeDef USB_DEVICE;

static uint8_t rx[MICROROS_RX_SIZE];
/* One belongs to the last accepted transfer, which may be in flight; `tx_free` is the index of the other one. */
static uint8_t tx[2][MICROROS_TX_SIZE];
static uint8_t tx_free;
static bool is_stuck;            /* the last write timed out */
static volatile size_t rx_first; /* position of the next byte to read; only the reader changes it */
static volatile size_t rx_end;   /* position after the last one; only the interrupt changes it */
static volatile bool is_held;    /* the next packet was not asked for, because the buffer is full */
static bool is_open;

static size_t rx_room(void)
{
  return (rx_first + MICROROS_RX_SIZE - rx_end - 1u) % MICROROS_RX_SIZE;
}

/*
 * Called by the interrupt of USB. There is room for a packet, unless the computer has configured the device again while
 * the buffer was full: the rest of that packet is lost, as what was on the line before is.
 */
static int8_t usb_received(uint8_t * data, uint32_t * size)
{
  const size_t room = rx_room();
  const size_t count = *size < room ? *size : room;
  size_t end = rx_end;

  for (size_t i = 0; i < count; ++i) {
    rx[end] = data[i];
    end = (end + 1u) % MICROROS_RX_SIZE;
  }
  rx_end = end;
  (void)USBD_CDC_SetRxBuffer(&USB_DEVICE, data);
  if (rx_room() < (size_t)USB_PACKET) {
    is_held = true;
    return (int8_t)USBD_OK;
  }
  return (int8_t)USBD_CDC_ReceivePacket(&USB_DEVICE);
}

/* Called again after each outage of the agent. */
bool cubemx_transport_open(struct uxrCustomTransport * transport)
{
  (void)transport;
  if (!is_open) {
    USB_FUNCTIONS.Receive = usb_received;
    is_open = true;
  }
  return true;
}

/* What the computer sends later waits for the next session. */
bool cubemx_transport_close(struct uxrCustomTransport * transport)
{
  (void)transport;
  return true;
}

/*
 * Before the computer has configured the device, CDC_Transmit of STM32CubeMX reads through a null pointer
 * (usbd_cdc_if.c: pClassData).
 */
static uint8_t usb_transmit(uint8_t * data, size_t size)
{
  if (USB_DEVICE.dev_state != (uint8_t)USBD_STATE_CONFIGURED) {
    return (uint8_t)USBD_BUSY;
  }
  return (uint8_t)USB_TRANSMIT(data, (uint16_t)size);
}

/*
 * Waits until the device has sent the bytes of the previous write. Without a computer that reads, the time runs out; later
 * writes do not wait until the device takes bytes again. After the cable was pulled no transfer completes: so the device
 * is asked, which is configured again when it is plugged in.
 */
size_t cubemx_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const uint32_t start_ms = HAL_GetTick();
  const uint32_t limit_ms = is_stuck ? 0u : (uint32_t)MICROROS_WRITE_TIMEOUT_MS;
  const size_t size = len < sizeof(tx[0]) ? len : sizeof(tx[0]);
  uint8_t result;

  (void)transport;
  (void)memcpy(tx[tx_free], buf, size);
  result = usb_transmit(tx[tx_free], size);
  while (result == (uint8_t)USBD_BUSY && (HAL_GetTick() - start_ms) < limit_ms) {
    cubemx_rest();
    result = usb_transmit(tx[tx_free], size);
  }
  is_stuck = result == (uint8_t)USBD_BUSY;
  if (result != (uint8_t)USBD_OK) {
    *err = result;
    return 0;
  }
  tx_free = (uint8_t)(1u - tx_free);
  return size;
}

static void held_packet_accept(void)
{
  if (is_held && rx_room() >= (size_t)USB_PACKET) {
    const uint32_t mask = __get_PRIMASK();

    __disable_irq(); /* between this task and the interrupt of USB */
    is_held = false;
    (void)USBD_CDC_ReceivePacket(&USB_DEVICE);
    __set_PRIMASK(mask);
  }
}

size_t cubemx_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  const uint32_t start_ms = HAL_GetTick();
  size_t count = 0;

  (void)transport;
  (void)err;
  while (rx_end == rx_first) {
    if (!cubemx_rest_until(start_ms, timeout)) {
      return 0;
    }
  }
  while (count < len && rx_end != rx_first) {
    buf[count] = rx[rx_first];
    ++count;
    rx_first = (rx_first + 1u) % MICROROS_RX_SIZE;
  }
  held_packet_accept();
  return count;
}

#endif
