/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_lwip.h"

#include <string.h>

bool port_multicast_open(port_multicast_t * multicast)
{
  struct netconn * connection = port_lwip_open(NETCONN_UDP, IP4_ADDR_ANY);

  multicast->handle = (intptr_t)connection;
  return connection != NULL;
}

void port_multicast_close(port_multicast_t * multicast)
{
  port_lwip_close((struct netconn *)multicast->handle);
  multicast->handle = 0;
}

bool port_multicast_send(
  port_multicast_t * multicast, const char * group, uint16_t port, const uint8_t * data, size_t size)
{
  ip_addr_t address;
  struct netbuf * datagram = ipaddr_aton(group, &address) != 0 ? port_lwip_datagram(data, size) : NULL;
  bool is_sent = false;

  if (datagram != NULL) {
    is_sent = netconn_sendto((struct netconn *)multicast->handle, datagram, &address, port) == ERR_OK;
    netbuf_delete(datagram);
  }
  return is_sent;
}

size_t port_multicast_receive(
  port_multicast_t * multicast, uint8_t * buffer, size_t capacity, uint8_t * sender)
{
  struct netbuf * datagram = NULL;
  uint32_t from;
  size_t size;

  if (netconn_recv((struct netconn *)multicast->handle, &datagram) != ERR_OK) {
    return 0;
  }
  from = ip4_addr_get_u32(ip_2_ip4(netbuf_fromaddr(datagram))); /* as on the wire */
  (void)memcpy(sender, &from, PORT_MULTICAST_ADDRESS);
  size = netbuf_copy(datagram, buffer, (u16_t)(capacity < (size_t)UINT16_MAX ? capacity : (size_t)UINT16_MAX));
  netbuf_delete(datagram);
  return size;
}
