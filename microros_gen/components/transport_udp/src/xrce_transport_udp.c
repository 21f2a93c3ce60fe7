/* SPDX-License-Identifier: Apache-2.0 */
/* One datagram is one message (OMG DDS-XRCE 1.0, 11.2). */
#include "microros/xrce_transport.h"

bool xrce_plain_open(xrce_transport_t * transport)
{
  return port_udp_open(&transport->udp, transport->host, transport->port);
}

void xrce_plain_close(xrce_transport_t * transport)
{
  port_udp_close(&transport->udp);
}

bool xrce_plain_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return port_udp_send(&transport->udp, message, size);
}

int32_t xrce_plain_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  return port_udp_receive(&transport->udp, buffer, capacity);
}
