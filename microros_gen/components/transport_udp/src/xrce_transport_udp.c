/* SPDX-License-Identifier: Apache-2.0 */
/* One datagram is one message (OMG DDS-XRCE 1.0, 11.2). */
#include "microros/xrce_transport.h"

bool xrce_transport_open(xrce_transport_t * transport)
{
  return xrce_datagrams_open(&transport->udp, transport->host, transport->port);
}

void xrce_transport_close(xrce_transport_t * transport)
{
  xrce_datagrams_close(&transport->udp);
}

bool xrce_transport_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  return xrce_datagrams_send(&transport->udp, message, size);
}

int32_t xrce_transport_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  return xrce_datagrams_receive(&transport->udp, buffer, capacity);
}
