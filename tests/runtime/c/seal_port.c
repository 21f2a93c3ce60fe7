/* SPDX-License-Identifier: Apache-2.0 */
/* A port for sealed messages in a shared library: what is sent and received in two queues, as datagrams or parts of a
 * stream, a clock and a key that the test sets. */
#include "microros/port.h"
#include "microros/seal.h"
#include "microros/xrce_transport.h"
#include "microros_config.h"

#include <string.h>

enum { QUEUE = 64, LARGEST = 2048 };

typedef struct queue_t {
  size_t size[QUEUE];
  uint8_t data[QUEUE][LARGEST];
  size_t count;
} queue_t;

static queue_t incoming;
static queue_t outgoing;
static xrce_transport_t transport;
static bool hung_up; /* the connection is closed by its other end */
static size_t room = SIZE_MAX; /* bytes of a stream that the port accepts */
static uint32_t clock_ms;
static uint8_t key[MICROROS_SEAL_KEY];
static bool has_key;

static bool push(queue_t * queue, const uint8_t * data, size_t size)
{
  if (queue->count == QUEUE || size > LARGEST) {
    return false;
  }
  memcpy(queue->data[queue->count], data, size);
  queue->size[queue->count++] = size;
  return true;
}

static int32_t pop(queue_t * queue, uint8_t * data, size_t capacity)
{
  size_t size = queue->size[0];

  if (queue->count == 0) {
    return 0;
  }
  if (size > capacity) {
    size = 0;
  }
  memcpy(data, queue->data[0], size);
  --queue->count;
  memmove(queue->data[0], queue->data[1], queue->count * LARGEST);
  memmove(&queue->size[0], &queue->size[1], queue->count * sizeof(queue->size[0]));
  return size > 0 ? (int32_t)size : -1;
}

uint32_t port_time_ms(void) { return clock_ms; }

#if defined(SEAL_UDP)
bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  (void)host;
  (void)port;
  udp->handle = 1;
  incoming.count = 0;
  return true;
}

void port_udp_close(port_udp_t * udp) { udp->handle = -1; }

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  (void)udp;
  return push(&outgoing, data, size);
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  (void)udp;
  return pop(&incoming, buffer, capacity);
}
#else
/* Takes bytes of the oldest part of the stream. */
static size_t take(uint8_t * buffer, size_t capacity)
{
  size_t size = incoming.size[0];

  if (incoming.count == 0) {
    return 0;
  }
  if (size <= capacity) {
    return (size_t)pop(&incoming, buffer, capacity);
  }
  memcpy(buffer, incoming.data[0], capacity);
  memmove(incoming.data[0], &incoming.data[0][capacity], size - capacity);
  incoming.size[0] = size - capacity;
  return capacity;
}
#endif

#if defined(SEAL_TCP)
bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port)
{
  (void)host;
  (void)port;
  tcp->handle = 1;
  incoming.count = 0;
  hung_up = false;
  return true;
}

void port_tcp_close(port_tcp_t * tcp) { tcp->handle = -1; }

int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size)
{
  const size_t taken = size < room ? size : room;

  (void)tcp;
  if (hung_up) {
    return -1;
  }
  room -= taken;
  return taken == 0 ? 0 : push(&outgoing, data, taken) ? (int32_t)taken : 0;
}

int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity)
{
  (void)tcp;
  return hung_up ? -1 : (int32_t)take(buffer, capacity);
}
#elif defined(SEAL_SERIAL)
bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  (void)device;
  (void)baud;
  serial->handle = 1;
  incoming.count = 0;
  return true;
}

void port_serial_close(port_serial_t * serial) { serial->handle = -1; }

/* What the plan gives the line. */
size_t port_serial_room(port_serial_t * serial)
{
  (void)serial;
  return room < MICROROS_SEND_BUFFER - 1u ? room : MICROROS_SEND_BUFFER - 1u;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  (void)serial;
  return push(&outgoing, data, size);
}

bool port_serial_is_idle(port_serial_t * serial)
{
  (void)serial;
  return true;
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  (void)serial;
  return take(buffer, capacity);
}
#endif

bool microros_seal_psk(uint32_t client_key, uint8_t psk[MICROROS_SEAL_KEY])
{
  memcpy(psk, key, sizeof(key));
  return has_key && client_key == 0xA1B2C3D4u;
}

void test_set_key(const uint8_t * bytes)
{
  has_key = bytes != NULL;
  if (has_key) {
    memcpy(key, bytes, sizeof(key));
  }
}

/* Starts as after a reset. */
void test_reset(void)
{
  memset(&transport, 0, sizeof(transport));
  room = SIZE_MAX;
  hung_up = false;
  incoming.count = 0;
  outgoing.count = 0;
}

void test_set_clock(uint32_t ms) { clock_ms = ms; }
bool test_deliver(const uint8_t * data, size_t size) { return push(&incoming, data, size); }
int32_t test_take(uint8_t * data, size_t capacity) { return pop(&outgoing, data, capacity); }
bool test_open(void) { return xrce_transport_open(&transport); }
void test_close(void) { xrce_transport_close(&transport); }
bool test_send(const uint8_t * data, size_t size) { return xrce_transport_send(&transport, data, size); }
int32_t test_receive(uint8_t * data, size_t capacity) { return xrce_transport_receive(&transport, data, capacity); }
uint32_t test_fault(void) { return transport.seal.fault; }
uint32_t test_is_ready(void) { return transport.seal.is_ready; }
uint32_t test_refused(void) { return transport.seal.refused; }
uint32_t test_replayed(void) { return transport.seal.replayed; }
void test_set_room(size_t bytes) { room = bytes; }
void test_hang_up(void) { hung_up = true; }
void test_set_next(uint32_t counter) { transport.seal.next = counter; }

/* Returns whether no byte of a key is left. */
bool test_is_wiped(void)
{
  static const uint8_t zeros[sizeof(xrce_noise_t)];

  return memcmp(&transport.seal.noise, zeros, sizeof(transport.seal.noise)) == 0 &&
         memcmp(transport.seal.sending, zeros, MICROROS_SEAL_KEY) == 0 &&
         memcmp(transport.seal.receiving, zeros, MICROROS_SEAL_KEY) == 0;
}
