/* SPDX-License-Identifier: Apache-2.0 */
/* transport: custom, framing: false */
#include "microros/xrce_custom_read.h"
#include "microros/xrce_custom_send.h"
#include "microros/xrce_transport.h"

bool xrce_plain_open(xrce_transport_t * transport)
{
  return transport->custom.open(&transport->custom);
}

bool xrce_plain_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return xrce_custom_send(transport, message, size);
}

int32_t xrce_plain_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  xrce_custom_note_reading(transport);
  return (int32_t)xrce_custom_read(transport, buffer, capacity, XRCE_CUSTOM_WAIT_MS);
}
