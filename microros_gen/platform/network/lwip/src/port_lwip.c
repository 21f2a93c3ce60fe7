/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_lwip.h"

#include "microros/port.h"

#include <string.h>

/* Called by lwIP's thread. */
static void lwip_event(struct netconn * connection, enum netconn_evt event, u16_t size)
{
  (void)connection;
  (void)size;
  if (event != NETCONN_EVT_SENDMINUS && event != NETCONN_EVT_RCVMINUS) {
    port_wake();
  }
}

struct netconn * port_lwip_open(enum netconn_type type, const ip_addr_t * peer)
{
  enum netconn_type family = type;
  struct netconn * connection;

#if LWIP_IPV6
  if (IP_IS_V6(peer)) {
    family = (enum netconn_type)(type | NETCONN_TYPE_IPV6);
  }
#else
  (void)peer;
#endif
  connection = netconn_new_with_callback(family, lwip_event);
  if (connection != NULL) {
    netconn_set_nonblocking(connection, 1);
  }
  return connection;
}

void port_lwip_close(struct netconn * connection)
{
  if (connection != NULL) {
    (void)netconn_delete(connection);
  }
}

/* As lwIP's sockets do: a driver that needs one buffer per datagram gets a copy. */
static bool datagram_fill(struct netbuf * datagram, const uint8_t * data, u16_t size)
{
#if LWIP_NETIF_TX_SINGLE_PBUF
  void * bytes = netbuf_alloc(datagram, size);

  if (bytes != NULL) {
    (void)memcpy(bytes, data, size);
  }
  return bytes != NULL;
#else
  return netbuf_ref(datagram, data, size) == ERR_OK;
#endif
}

struct netbuf * port_lwip_datagram(const uint8_t * data, size_t size)
{
  struct netbuf * datagram = size <= (size_t)UINT16_MAX ? netbuf_new() : NULL;

  if (datagram != NULL && !datagram_fill(datagram, data, (u16_t)size)) {
    netbuf_delete(datagram);
    datagram = NULL;
  }
  return datagram;
}
