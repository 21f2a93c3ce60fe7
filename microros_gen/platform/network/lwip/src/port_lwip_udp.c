/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_lwip.h"

struct netconn * port_lwip_udp(const char * host, uint16_t port, uint16_t local)
{
  ip_addr_t peer;
  struct netconn * connection = ipaddr_aton(host, &peer) != 0 ? port_lwip_open(NETCONN_UDP, &peer) : NULL;

  if (
    connection != NULL && ((local != 0u && netconn_bind(connection, NULL, local) != ERR_OK) ||
                           netconn_connect(connection, &peer, port) != ERR_OK)) {
    port_lwip_close(connection);
    connection = NULL;
  }
  return connection;
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  struct netconn * connection = port_lwip_udp(host, port, 0);

  udp->handle = (intptr_t)connection;
  return connection != NULL;
}

void port_udp_close(port_udp_t * udp)
{
  port_lwip_close((struct netconn *)udp->handle);
  udp->handle = 0;
}

/* The driver has sent or copied the bytes when the call returns, unless it has to ask for the peer's address first: then
 * lwIP keeps a copy. */
bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  struct netbuf * datagram = port_lwip_datagram(data, size);
  bool is_sent = false;

  if (datagram != NULL) {
    is_sent = netconn_send((struct netconn *)udp->handle, datagram) == ERR_OK;
    netbuf_delete(datagram);
  }
  return is_sent;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  struct netbuf * datagram = NULL;
  int32_t size;

  if (netconn_recv((struct netconn *)udp->handle, &datagram) != ERR_OK) {
    return 0; /* nothing arrived, or an ICMP error: nobody listens */
  }
  size = netbuf_len(datagram) <= capacity ? (int32_t)netbuf_copy(datagram, buffer, (u16_t)netbuf_len(datagram)) : -1;
  netbuf_delete(datagram);
  return size;
}
