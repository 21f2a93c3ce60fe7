/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_transport.h"

#include "microros_config.h"

#include <string.h>

size_t xrce_line_room(struct xrce_transport_t * line)
{
  return port_serial_room(&line->serial);
}

bool xrce_line_write(struct xrce_transport_t * line, const uint8_t * data, size_t size)
{
  return port_serial_write(&line->serial, data, size);
}

size_t xrce_line_read(struct xrce_transport_t * line, uint8_t * buffer, size_t capacity)
{
  return port_serial_read(&line->serial, buffer, capacity);
}

bool xrce_plain_open(xrce_transport_t * transport)
{
  (void)memset(&transport->framing, 0, sizeof(transport->framing));
  return port_serial_open(&transport->serial, xrce_transport_name(transport), MICROROS_SERIAL_BAUD);
}

void xrce_plain_close(xrce_transport_t * transport)
{
  port_serial_close(&transport->serial);
}

bool xrce_plain_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return xrce_framing_send(transport, message, size);
}

int32_t xrce_plain_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  return xrce_framing_receive(&transport->framing, transport, buffer, capacity);
}
