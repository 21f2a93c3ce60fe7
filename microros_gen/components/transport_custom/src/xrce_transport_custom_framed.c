/* SPDX-License-Identifier: Apache-2.0 */
/* transport: custom, framing: true */
#include "microros/xrce_transport.h"

bool xrce_plain_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return xrce_framing_send(transport, message, size);
}

int32_t xrce_plain_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  return xrce_framing_receive(&transport->framing, transport, buffer, capacity);
}
