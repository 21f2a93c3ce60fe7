/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reliable stream of `on_full: drop_oldest` on a line that carries a tenth of what is published:
 * unit_stream_saturated LOSS LATENCY_MS SEED. LOSS is in percent of the messages of each direction. Prints how many
 * messages the line can carry, those that it carried and those that the agent got meanwhile; then those that it got in the
 * end, and those that were dropped.
 */
#include "unit.h"

#include "microros/xrce_stream_reliable.h"
#include "microros/xrce_stream_reliable_slots.h"
#include "microros/xrce_wire.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum {
  PUBLISHED = 60000, /* one each millisecond; the numbers wrap after a sixth of what the line carries */
  FIRST = 0xfc00,
  LINE_MS = 10, /* for a whole slot, of which the line's own buffer holds one */
  DRAIN_MS = 5000,
  WINDOW = 16, /* of the agent */
  EVENTS = 256
};

/* What reaches the other side at a time. */
typedef struct event_t {
  uint32_t at_ms;
  size_t size;
  uint8_t bytes[MICROROS_RELIABLE_SLOT_SIZE];
} event_t;

typedef struct way_t {
  uint32_t first;
  uint32_t count;
  event_t events[EVENTS];
} way_t;

static xrce_session_t session;
static xrce_stream_reliable_t stream;
static way_t up;
static way_t down;
static uint32_t now_ms;
static uint32_t free_us; /* when the line is free again */
static uint32_t latency_ms;
static uint32_t loss;
static uint32_t chance;
static uint32_t carried;
static uint32_t delivered;
static uint32_t dropped;
static bool is_dropped[PUBLISHED];
static int32_t newest = -1; /* that was delivered */

/* The agent's side. */
static uint16_t next = FIRST;
static uint16_t announced; /* numbers from `next` on that exist */
static bool is_held[WINDOW];
static int32_t held[WINDOW];

static bool is_lost(void)
{
  chance ^= chance << 13;
  chance ^= chance >> 17;
  chance ^= chance << 5;
  return chance % 100u < loss;
}

static void put(way_t * way, uint32_t at_ms, const uint8_t * message, size_t size)
{
  event_t * event = &way->events[(way->first + way->count) % EVENTS];

  if (is_lost()) {
    return;
  }
  CHECK(way->count < (uint32_t)EVENTS && size <= sizeof(event->bytes));
  event->at_ms = at_ms;
  event->size = size;
  memcpy(event->bytes, message, size);
  ++way->count;
}

bool xrce_session_send(xrce_session_t * from, const uint8_t * message, size_t size)
{
  (void)from;
  if ((int32_t)(free_us - now_ms * 1000u) > 0) {
    return false;
  }
  free_us = now_ms * 1000u + (uint32_t)(size * LINE_MS * 1000u / MICROROS_RELIABLE_SLOT_SIZE);
  if (message[1] == XRCE_STREAM_RELIABLE) {
    ++carried;
  }
  put(&up, free_us / 1000u + latency_ms, message, size);
  return true;
}

uint32_t xrce_session_pause(uint32_t wanted_ms)
{
  return wanted_ms < 100u ? 100u : wanted_ms;
}

/* With one slot alone, what is dropped may be on its way. */
static void deliver(int32_t value)
{
  CHECK(value > newest && value < PUBLISHED && (MICROROS_RELIABLE_SLOTS == 1 || !is_dropped[value]));
  newest = value;
  ++delivered;
}

static void agent_advance(uint16_t count)
{
  for (; count != 0u; --count) {
    ++next;
    announced = announced != 0u ? (uint16_t)(announced - 1u) : 0u;
    memmove(&is_held[0], &is_held[1], sizeof(is_held) - sizeof(is_held[0]));
    memmove(&held[0], &held[1], sizeof(held) - sizeof(held[0]));
    is_held[WINDOW - 1] = false;
  }
}

static void agent_answer(void)
{
  uint8_t acknack[XRCE_ACKNACK_SIZE];
  uint16_t missing = 0;

  while (is_held[0]) {
    deliver(held[0]);
    agent_advance(1);
  }
  for (uint16_t i = 0; i < announced; ++i) {
    if (!is_held[i]) {
      missing = (uint16_t)(missing | 1u << i);
    }
  }
  xrce_put_le16(&acknack[0], next);
  xrce_put_be16(&acknack[2], missing);
  acknack[4] = XRCE_STREAM_RELIABLE;
  put(&down, now_ms + latency_ms, acknack, sizeof(acknack));
}

static void agent_on_heartbeat(const uint8_t * payload)
{
  const uint16_t skipped = (uint16_t)(xrce_get_le16(&payload[0]) - next);
  const uint16_t known = (uint16_t)(xrce_get_le16(&payload[2]) + 1u - next);

  if (skipped < 0x8000u) {
    agent_advance(skipped);
  }
  if (known < 0x8000u && known - skipped <= (uint16_t)WINDOW && skipped < 0x8000u) {
    announced = (uint16_t)(known - skipped);
  }
}

static void agent_on(const uint8_t * message, size_t size)
{
  if (message[1] == XRCE_STREAM_RELIABLE) {
    const uint16_t place = (uint16_t)(xrce_get_le16(&message[2]) - next);

    CHECK(place < (uint16_t)WINDOW || place >= 0x8000u);
    if (place < (uint16_t)WINDOW) {
      is_held[place] = true;
      memcpy(&held[place], &message[MICROROS_RELIABLE_FRONT], sizeof(held[0]));
      announced = announced > place ? announced : (uint16_t)(place + 1u);
    }
  } else {
    CHECK(size == 13u && message[4] == XRCE_HEARTBEAT);
    agent_on_heartbeat(&message[8]);
  }
  agent_answer();
}

static const event_t * due_of(way_t * way)
{
  const event_t * event = &way->events[way->first];

  if (way->count == 0u || event->at_ms > now_ms) {
    return NULL;
  }
  way->first = (way->first + 1u) % EVENTS;
  --way->count;
  return event;
}

/* A millisecond of both sides. */
static void pass(void)
{
  const event_t * event;

  ++now_ms;
  while ((event = due_of(&up)) != NULL) {
    agent_on(event->bytes, event->size);
  }
  while ((event = due_of(&down)) != NULL) {
    CHECK(xrce_stream_reliable_on_acknack(
      &stream, &session, event->bytes, event->size, XRCE_FLAG_LITTLE_ENDIAN, now_ms));
  }
  xrce_stream_reliable_step(&stream, &session, true, now_ms);
}

static void publish(int32_t value)
{
  uint8_t * room = xrce_stream_reliable_reserve(&stream, &session);

  if (room == NULL) {
    const uint8_t * oldest = xrce_stream_reliable_drop_oldest(&stream, &session, now_ms);
    int32_t old;

    CHECK(oldest != NULL);
    memcpy(&old, oldest, sizeof(old));
    CHECK(old < value && !is_dropped[old]);
    is_dropped[old] = true;
    ++dropped;
    room = xrce_stream_reliable_reserve(&stream, &session);
  }
  CHECK(room != NULL);
  memset(room, 0, MICROROS_RELIABLE_SLOT_SIZE - MICROROS_RELIABLE_FRONT);
  memcpy(room, &value, sizeof(value));
  xrce_stream_reliable_commit(
    &stream, &session, MICROROS_RELIABLE_SLOT_SIZE - MICROROS_RELIABLE_FRONT, now_ms);
}

int main(int count, char * arguments[])
{
  CHECK(count == 4);
  loss = (uint32_t)strtoul(arguments[1], NULL, 10);
  latency_ms = (uint32_t)strtoul(arguments[2], NULL, 10);
  chance = (uint32_t)strtoul(arguments[3], NULL, 10) * 2654435761u + 1u;
  session.state = XRCE_READY;
  session.transport_open = true;
  stream.first = FIRST;
  for (int32_t value = 0; value < PUBLISHED; ++value) {
    pass();
    publish(value);
  }
  (void)printf("%u %u %u ", (unsigned)(PUBLISHED / LINE_MS), (unsigned)carried, (unsigned)delivered);
  for (uint32_t i = 0; i < (uint32_t)DRAIN_MS; ++i) {
    pass();
  }
  CHECK(stream.count == 0u && newest == PUBLISHED - 1);
  (void)printf("%u %u\n", (unsigned)delivered, (unsigned)dropped);
  return 0;
}
