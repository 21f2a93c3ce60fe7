/* SPDX-License-Identifier: Apache-2.0 */
/* Each message is preceded by its length in two bytes, little endian (OMG DDS-XRCE 1.0, 11.3). */
#include "microros/xrce_transport.h"

#include "microros/xrce_largest_sent.h"
#include "microros/xrce_turn_bytes.h"
#include "microros/xrce_wire.h"

#include <string.h>

static void transport_abandon(xrce_transport_t * transport)
{
  port_tcp_close(&transport->tcp);
  transport->closed = true;
}

/* Starts to connect. */
bool xrce_plain_open(xrce_transport_t * transport)
{
  transport->unsent = 0;
  transport->length_arrived = 0;
  transport->arrived = 0;
  transport->closed = false;
  return port_tcp_open(&transport->tcp, transport->host, transport->port);
}

void xrce_plain_close(xrce_transport_t * transport)
{
  if (!transport->closed) {
    port_tcp_close(&transport->tcp);
  }
}

/* Sends waiting bytes. */
static void transport_flush(xrce_transport_t * transport)
{
  /* at most XRCE_TCP_PREFIX + XRCE_SEALED_MOST or XRCE_TCP_PREFIX + MICROROS_MTU rounds: each sends a byte or more */
  while (!transport->closed && transport->unsent != 0u) {
    const int32_t taken =
      port_tcp_send(&transport->tcp, &transport->output[transport->sent], transport->unsent);

    if (taken < 0) {
      transport_abandon(transport);
    }
    if (taken <= 0) {
      return;
    }
    transport->sent = (uint16_t)(transport->sent + (uint32_t)taken);
    transport->unsent = (uint16_t)(transport->unsent - (uint32_t)taken);
  }
}

/*
 * Bytes for which the connection has no room follow with later calls, including receive calls, as does a first message
 * while the connection is being established. */
bool xrce_plain_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  if (size > (size_t)XRCE_LARGEST_SENT) {
    return false;
  }
  transport_flush(transport);
  if (transport->closed || transport->unsent != 0u) {
    return false;
  }
  xrce_put_le16(transport->output, (uint16_t)size);
  /* at most XRCE_SEALED_MOST or MICROROS_MTU bytes */
  (void)memcpy(&transport->output[XRCE_TCP_PREFIX], message, size);
  transport->sent = 0;
  transport->unsent = (uint16_t)(XRCE_TCP_PREFIX + size);
  transport_flush(transport);
  return !transport->closed;
}

/* Reads at most `capacity` bytes; 0 if nothing has arrived or the connection is closed. */
static uint16_t transport_read(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  const int32_t size = port_tcp_receive(&transport->tcp, buffer, capacity);

  if (size < 0) {
    transport_abandon(transport);
  }
  return size > 0 ? (uint16_t)size : 0u;
}

/* Returns whether the length of the message is complete. */
static bool transport_read_length(xrce_transport_t * transport)
{
  while (transport->length_arrived != XRCE_TCP_PREFIX) { /* at most XRCE_TCP_PREFIX rounds */
    const uint16_t size = transport_read(
      transport, &transport->length[transport->length_arrived],
      (size_t)XRCE_TCP_PREFIX - transport->length_arrived);

    if (size == 0u) {
      return false;
    }
    transport->length_arrived = (uint8_t)(transport->length_arrived + size);
    transport->size = xrce_get_le16(transport->length);
    transport->arrived = 0;
  }
  return true;
}

/* Discards what is longer than `capacity`, or empty. */
int32_t xrce_plain_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  bool fits;

  transport_flush(transport);
  if (transport->closed || !transport_read_length(transport)) {
    return 0;
  }
  fits = transport->size <= capacity && transport->size != 0u;
  while (transport->arrived != transport->size) { /* at most XRCE_TURN_READS rounds */
    const size_t left = (size_t)transport->size - transport->arrived;
    const uint16_t size = fits ? transport_read(transport, &buffer[transport->arrived], left)
                               : transport_read(transport, buffer, left < capacity ? left : capacity);

    if (size == 0u) {
      return 0;
    }
    transport->arrived = (uint16_t)(transport->arrived + size);
    /* cppcheck-suppress knownConditionTrueFalse ; without a task for the session it reads until nothing has arrived */
    if (xrce_turn_ends_with_read() && transport->arrived != transport->size) {
      return XRCE_TURN_PARTIAL; /* it may arrive one byte at a time: the lock is released in between */
    }
  }
  transport->length_arrived = 0;
  return fits ? (int32_t)transport->size : -1;
}
