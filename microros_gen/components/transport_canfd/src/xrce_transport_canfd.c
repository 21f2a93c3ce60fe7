/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One frame is one message, as the public client and agent have it: the first byte is the length of the message, since
 * a frame longer than eight bytes has one of seven lengths and is filled up. The checksum is that of CAN. */
#include "microros/xrce_transport.h"

#include <string.h>

enum { LENGTH_SIZE = 1 };

/* Returns the shortest length of a CAN FD frame (ISO 11898-1) that holds `size` bytes, 1 to 64. */
static size_t canfd_length(size_t size)
{
  static const uint8_t lengths[] = {12, 16, 20, 24, 32, 48, PORT_CAN_DATA};
  size_t i = 0;

  if (size <= 8u) {
    return size;
  }
  while (lengths[i] < size) { /* at most 6 rounds */
    ++i;
  }
  return lengths[i];
}

bool xrce_plain_open(xrce_transport_t * transport)
{
  return port_can_open(&transport->can, transport->device, transport->id);
}

void xrce_plain_close(xrce_transport_t * transport)
{
  port_can_close(&transport->can);
}

/* At most 63 bytes. */
bool xrce_plain_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  uint8_t data[PORT_CAN_DATA];

  if (size > sizeof(data) - LENGTH_SIZE) {
    return false;
  }
  (void)memset(data, 0, sizeof(data));
  data[0] = (uint8_t)size;
  (void)memcpy(&data[LENGTH_SIZE], message, size); /* at most PORT_CAN_DATA bytes */
  return port_can_send(&transport->can, data, canfd_length(LENGTH_SIZE + size));
}

int32_t xrce_plain_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  uint8_t data[PORT_CAN_DATA];
  const size_t received = port_can_receive(&transport->can, data);
  size_t size;

  if (received == 0u) {
    return 0;
  }
  size = data[0];
  if (size == 0u || size > received - LENGTH_SIZE || size > capacity) {
    return -1;
  }
  (void)memcpy(buffer, &data[LENGTH_SIZE], size); /* at most PORT_CAN_DATA bytes */
  return (int32_t)size;
}
