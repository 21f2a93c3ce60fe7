/* SPDX-License-Identifier: Apache-2.0 */
/* transport: custom; the application selects framing at run time. */
#include "microros/xrce_custom_read.h"
#include "microros/xrce_custom_send.h"
#include "microros/xrce_transport.h"

bool xrce_plain_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return transport->custom.framing ? xrce_framing_send(transport, message, size)
                                   : xrce_custom_send(transport, message, size);
}

int32_t xrce_plain_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  xrce_custom_note_reading(transport);
  return transport->custom.framing
           ? xrce_framing_receive(&transport->framing, transport, buffer, capacity)
           : (int32_t)xrce_custom_read(transport, buffer, capacity, XRCE_CUSTOM_WAIT_MS);
}
