/* SPDX-License-Identifier: Apache-2.0 */
/* A port for sealed datagrams in a shared library: datagrams in two queues, a clock and a key that the test sets. */
#include "microros/port.h"
#include "microros/seal.h"
#include "microros/xrce_datagrams.h"

#include <string.h>

enum { QUEUE = 64, LARGEST = 2048 };

typedef struct queue_t {
  size_t size[QUEUE];
  uint8_t data[QUEUE][LARGEST];
  size_t count;
} queue_t;

static queue_t incoming;
static queue_t outgoing;
static xrce_datagrams_t datagrams;
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
  memset(&datagrams, 0, sizeof(datagrams));
  incoming.count = 0;
  outgoing.count = 0;
}

void test_set_clock(uint32_t ms) { clock_ms = ms; }
bool test_deliver(const uint8_t * data, size_t size) { return push(&incoming, data, size); }
int32_t test_take(uint8_t * data, size_t capacity) { return pop(&outgoing, data, capacity); }
bool test_open(void) { return xrce_datagrams_open(&datagrams, "", 1); }
void test_close(void) { xrce_datagrams_close(&datagrams); }
bool test_send(const uint8_t * data, size_t size) { return xrce_datagrams_send(&datagrams, data, size); }
int32_t test_receive(uint8_t * data, size_t capacity) { return xrce_datagrams_receive(&datagrams, data, capacity); }
uint32_t test_fault(void) { return datagrams.fault; }
uint32_t test_is_ready(void) { return datagrams.is_ready; }
uint32_t test_refused(void) { return datagrams.refused; }
uint32_t test_replayed(void) { return datagrams.replayed; }
void test_set_next(uint32_t counter) { datagrams.next = counter; }

/* Returns whether no byte of a key is left. */
bool test_is_wiped(void)
{
  static const uint8_t zeros[sizeof(xrce_noise_t)];

  return memcmp(&datagrams.noise, zeros, sizeof(datagrams.noise)) == 0 &&
         memcmp(datagrams.sending, zeros, MICROROS_SEAL_KEY) == 0 &&
         memcmp(datagrams.receiving, zeros, MICROROS_SEAL_KEY) == 0;
}
