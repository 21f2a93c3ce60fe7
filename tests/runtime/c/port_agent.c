/* SPDX-License-Identifier: Apache-2.0 */
#include "port_agent.h"

#include <stdlib.h>
#include <string.h>

enum { QUEUE = 64, DATAGRAM = 64, HEADER = 4, MS = 1000000, ENDPOINTS = 32 };
enum {
  CREATE_CLIENT = 0,
  CREATE = 1,
  GET_INFO = 2,
  DELETE = 3,
  WRITE_DATA = 7,
  READ_DATA = 8,
  RELIABLE = 0x80
};
enum { READER = 6, REQUESTER = 7, REPLIER = 8 };

typedef struct datagram_t {
  size_t size;
  uint8_t bytes[DATAGRAM];
} datagram_t;

int64_t agent_now_ns = INT64_C(0xffffff00) * MS;
int64_t agent_epoch_ns;
uint32_t agent_waits;
bool agent_silent;
void (*agent_asked)(uint8_t id);
int64_t agent_event_ns = INT64_MAX;
void (*agent_event)(void);
port_timer_tick_t agent_ticks[4];
int64_t agent_periods[4];
agent_reply_t agent_replies[AGENT_REPLIES];
size_t agent_reply_count;
bool agent_keeps_silent;

static datagram_t queue[QUEUE];
static size_t queue_count;
static uint16_t sequence[2]; /* of the agent's streams: best effort, reliable */
static uint8_t requests[ENDPOINTS][2];
static uint8_t asked[ENDPOINTS][2]; /* the last request of a requester */
static uint8_t unacknowledged[4];   /* the header of the last message that was not acknowledged */
static uint32_t written;
static int32_t written_last;
static bool woken;

uint32_t port_time_ms(void)
{
  return (uint32_t)(agent_now_ns / MS);
}

int64_t port_time_steady_ns(void)
{
  return agent_now_ns;
}

int64_t port_time_epoch_ns(void)
{
  return agent_epoch_ns;
}

uint32_t port_unique_id(void)
{
  return 1;
}

/* Returns whether an event came before `until_ns`; time is then that of the event. */
static bool pass(int64_t until_ns)
{
  void (*event)(void) = agent_event;

  if (event == NULL || agent_event_ns > until_ns) {
    agent_now_ns = until_ns;
    return false;
  }
  agent_now_ns = agent_event_ns > agent_now_ns ? agent_event_ns : agent_now_ns;
  agent_event = NULL;
  event();
  return true;
}

void port_sleep_ms(uint32_t duration_ms)
{
  const int64_t until_ns = agent_now_ns + (int64_t)duration_ms * MS;

  while (pass(until_ns)) {
    /* events do not end a sleep */
  }
}

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  const int64_t until_ns = agent_now_ns + (int64_t)timeout_ms * MS;

  ++agent_waits;
  if (handle != 1 || timeout_ms == 0u || agent_waits > 100000u) {
    abort();
  }
  while (!woken && queue_count == 0u && pass(until_ns)) {
    /* it may have been the event of something else */
  }
  woken = false;
}

void port_wake(void)
{
  woken = true;
}

bool port_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick)
{
  agent_ticks[timer] = tick;
  agent_periods[timer] = period_ns;
  return period_ns > 0;
}

void port_timer_stop(uint16_t timer)
{
  agent_ticks[timer] = NULL;
}

bool port_hardware_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick)
{
  return port_timer_start(timer, period_ns, tick);
}

void port_hardware_timer_stop(uint16_t timer)
{
  port_timer_stop(timer);
}

static uint8_t * send_begin(uint8_t stream, uint8_t id, uint8_t size)
{
  datagram_t * datagram = &queue[queue_count];
  uint16_t * number = &sequence[stream == RELIABLE ? 1 : 0];
  uint8_t * bytes = datagram->bytes;

  if (queue_count == QUEUE || size > DATAGRAM - 8) {
    abort();
  }
  ++queue_count;
  datagram->size = 8u + size;
  memset(bytes, 0, sizeof(datagram->bytes));
  bytes[0] = 0x81;
  bytes[1] = stream;
  if (stream != 0u) {
    bytes[2] = (uint8_t)(*number & 0xffu);
    bytes[3] = (uint8_t)(*number >> 8);
    ++*number;
  }
  bytes[4] = id;
  bytes[5] = 1;
  bytes[6] = size;
  return &bytes[8];
}

static void answer_acknack(const uint8_t * message)
{
  const uint16_t next = (uint16_t)(((uint32_t)message[2] | (uint32_t)message[3] << 8) + 1u);
  uint8_t * acknack = send_begin(0, 0x0a, 5);

  acknack[0] = (uint8_t)(next & 0xffu);
  acknack[1] = (uint8_t)(next >> 8);
  acknack[4] = message[1];
}

static void answer_session(void)
{
  static const uint8_t granted[] = {0, 0, 0x58, 0x52, 0x43, 0x45, 1, 0, 1, 0x0f, 0};

  sequence[0] = 0;
  sequence[1] = 0;
  memcpy(send_begin(0, 4, sizeof(granted)), granted, sizeof(granted));
}

static uint16_t index_of(const uint8_t * payload)
{
  return (uint16_t)(((uint32_t)payload[2] << 4 | (uint32_t)payload[3] >> 4) % ENDPOINTS);
}

/* A sample, a request or a reply. */
static void take_written(const uint8_t * payload)
{
  enum { SAMPLE = 4, NUMBER = SAMPLE + 20, REPLY = SAMPLE + 24 };
  const uint8_t kind = payload[3] & 0x0fu;

  if (kind == REQUESTER) {
    memcpy(asked[index_of(payload)], payload, 2);
  } else if (kind == REPLIER) {
    agent_reply_t * reply = &agent_replies[agent_reply_count];

    if (agent_reply_count == AGENT_REPLIES) {
      abort();
    }
    ++agent_reply_count;
    reply->index = index_of(payload);
    memcpy(&reply->number, &payload[NUMBER], sizeof(reply->number));
    memcpy(&reply->value, &payload[REPLY], sizeof(reply->value));
  } else {
    ++written;
    memcpy(&written_last, &payload[SAMPLE], sizeof(written_last));
  }
}

static void take(uint8_t stream, const uint8_t * submessage)
{
  const uint8_t * payload = &submessage[HEADER];

  switch (submessage[0]) {
    case CREATE_CLIENT:
      answer_session();
      break;
    case CREATE:
    case DELETE:
      memcpy(send_begin(stream == RELIABLE ? RELIABLE : 1, 5, 6), payload, 4);
      break;
    case GET_INFO:
      send_begin(0, 6, 12)[5] = 1; /* in session */
      break;
    case WRITE_DATA:
      take_written(payload);
      break;
    case READ_DATA:
      memcpy(requests[index_of(payload)], payload, 2);
      break;
    default:
      break;
  }
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  (void)host;
  (void)port;
  udp->handle = 1;
  queue_count = 0;
  return true;
}

void port_udp_close(port_udp_t * udp)
{
  udp->handle = -1;
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  (void)udp;
  if (agent_asked != NULL) {
    agent_asked(data[HEADER]);
  }
  if (agent_silent) {
    return true;
  }
  if (data[1] == RELIABLE) {
    memcpy(unacknowledged, data, sizeof(unacknowledged));
  }
  if (data[1] > RELIABLE || (data[1] == RELIABLE && !agent_keeps_silent)) {
    answer_acknack(data);
  }
  for (size_t at = HEADER; at + HEADER <= size;) {
    take(data[1], &data[at]);
    at = (at + HEADER + ((size_t)data[at + 2u] | (size_t)data[at + 3u] << 8) + 3u) & ~(size_t)3u;
  }
  return true;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  const int32_t size = (int32_t)queue[0].size;

  (void)udp;
  if (queue_count == 0u) {
    return 0;
  }
  if (queue[0].size > capacity) {
    abort();
  }
  memcpy(buffer, queue[0].bytes, queue[0].size);
  --queue_count;
  memmove(queue, &queue[1], queue_count * sizeof(queue[0]));
  return size;
}

void agent_inject(const uint8_t * bytes, size_t size)
{
  datagram_t * datagram = &queue[queue_count];

  if (queue_count < QUEUE / 2 && size != 0u) {
    ++queue_count;
    datagram->size = size < DATAGRAM ? size : DATAGRAM;
    memcpy(datagram->bytes, bytes, datagram->size);
  }
}

static void offer(uint16_t index, uint8_t kind, const uint8_t * body, uint8_t size)
{
  uint8_t * payload = send_begin(1, 9, (uint8_t)(size + 4u));

  memcpy(payload, requests[index], 2);
  payload[2] = (uint8_t)(index >> 4);
  payload[3] = (uint8_t)((uint32_t)index << 4 | kind);
  memcpy(&payload[4], body, size);
}

void agent_offer(uint16_t index, const uint8_t * body, uint8_t size)
{
  offer(index, READER, body, size);
}

void agent_offer_request(uint16_t index, uint32_t number, int32_t value)
{
  uint8_t body[28] = {1, 15};

  memcpy(&body[20], &number, sizeof(number));
  memcpy(&body[24], &value, sizeof(value));
  offer(index, REPLIER, body, sizeof(body));
}

void agent_offer_reply(uint16_t index, int32_t value)
{
  uint8_t body[8];

  memcpy(body, asked[index], 2);
  body[2] = (uint8_t)(index >> 4);
  body[3] = (uint8_t)((uint32_t)index << 4 | REQUESTER);
  memcpy(&body[4], &value, sizeof(value));
  offer(index, REQUESTER, body, sizeof(body));
}

void agent_acknowledge(void)
{
  answer_acknack(unacknowledged);
}

void agent_offer_number(uint16_t index, int32_t value)
{
  uint8_t body[4];

  memcpy(body, &value, sizeof(body)); /* the machines of the tests are little endian */
  agent_offer(index, body, sizeof(body));
}

uint32_t agent_written(int32_t * last)
{
  const uint32_t count = written;

  written = 0;
  *last = written_last;
  return count;
}
