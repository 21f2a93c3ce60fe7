/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_lwip.h"

#include "lwip/tcp.h"

/* A connection, and received bytes that the library has not taken yet. */
typedef struct lwip_stream_t {
  struct netconn * connection; /* NULL: free */
  struct pbuf * received;
  u16_t taken;
} lwip_stream_t;

enum { STREAMS = 2 }; /* that of the session, and one to another agent that is pinged */

static lwip_stream_t streams[STREAMS];

static bool stream_begin(lwip_stream_t * stream, const ip_addr_t * peer, uint16_t port)
{
  struct netconn * connection = port_lwip_open(NETCONN_TCP, peer);
  err_t begun = ERR_MEM;

  if (connection != NULL) {
    tcp_nagle_disable(connection->pcb.tcp); /* otherwise a message waits for the acknowledgement of the previous one */
    begun = netconn_connect(connection, peer, port);
  }
  if (begun != ERR_OK && begun != ERR_INPROGRESS) {
    port_lwip_close(connection);
    connection = NULL;
  }
  stream->connection = connection;
  return connection != NULL;
}

bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port)
{
  ip_addr_t peer;

  tcp->handle = -1;
  if (ipaddr_aton(host, &peer) == 0) {
    return false;
  }
  for (size_t i = 0; i < (size_t)STREAMS; ++i) {
    if (streams[i].connection == NULL) {
      tcp->handle = stream_begin(&streams[i], &peer, port) ? (intptr_t)i : -1;
      break;
    }
  }
  return tcp->handle >= 0;
}

static void stream_clear(lwip_stream_t * stream)
{
  if (stream->received != NULL) {
    (void)pbuf_free(stream->received);
  }
  stream->received = NULL;
  stream->taken = 0;
}

void port_tcp_close(port_tcp_t * tcp)
{
  if (tcp->handle >= 0) {
    lwip_stream_t * stream = &streams[tcp->handle];

    stream_clear(stream);
    port_lwip_close(stream->connection);
    stream->connection = NULL;
  }
  tcp->handle = -1;
}

/* Whether the connection only needs time: it is being established, has no room, or nothing arrived. */
static bool needs_time(err_t error)
{
  return error == ERR_WOULDBLOCK || error == ERR_INPROGRESS || error == ERR_ALREADY || error == ERR_MEM;
}

int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size)
{
  struct netconn * connection = streams[tcp->handle].connection;
  size_t sent = 0;
  err_t result;

  if (netconn_is_flag_set(connection, NETCONN_FLAG_IN_NONBLOCKING_CONNECT)) {
    return 0;
  }
  result = netconn_write_partly(connection, data, size, NETCONN_COPY, &sent);
  if (result == ERR_OK) {
    return (int32_t)sent;
  }
  return needs_time(result) ? 0 : -1;
}

int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity)
{
  lwip_stream_t * stream = &streams[tcp->handle];
  u16_t size;

  if (stream->received == NULL) {
    const err_t result = netconn_recv_tcp_pbuf(stream->connection, &stream->received);

    if (result != ERR_OK) {
      stream->received = NULL;
      return needs_time(result) || netconn_is_flag_set(stream->connection, NETCONN_FLAG_IN_NONBLOCKING_CONNECT) ? 0 : -1;
    }
    stream->taken = 0;
  }
  size = (u16_t)(capacity < (size_t)UINT16_MAX ? capacity : (size_t)UINT16_MAX);
  size = pbuf_copy_partial(stream->received, buffer, size, stream->taken);
  stream->taken = (u16_t)(stream->taken + size);
  if (stream->taken == stream->received->tot_len) {
    stream_clear(stream);
  }
  return (int32_t)size;
}
