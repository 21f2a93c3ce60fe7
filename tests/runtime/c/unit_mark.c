/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Waiting for what a reliable stream has stored: unit_mark SEED. Random writes, acknowledgements, drops, lost sessions,
 * new ones and creations in the stream, with numbers that wrap, against a list of the stored messages.
 */
#include "unit.h"

#include "microros/xrce_mark.h"
#include "microros/xrce_stream_reliable.h"
#include "microros/xrce_stream_reliable_slots.h"
#include "microros/xrce_wire.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { WAITS = 10000, STEPS = 400, SIZE = MICROROS_RELIABLE_SLOT_SIZE - MICROROS_RELIABLE_FRONT };
enum { NUMBERS = MICROROS_RELIABLE_SLOTS * (1 + MICROROS_RELIABLE_SLOT_SIZE / (MICROROS_MTU - 8)) };

static xrce_session_t session;
static xrce_stream_reliable_t stream;
static uint32_t chance;
static uint32_t now_ms;

/* The stored messages, the oldest one first. */
static uint32_t stored[MICROROS_RELIABLE_SLOTS];
static uint32_t stored_count;
static uint32_t written;

/* Of one wait. */
static uint32_t marked_end; /* the first message that is not waited for */
static uint32_t later;      /* messages from there on that are acknowledged */
static uint32_t sessions;
static uint32_t drops;
static bool was_held;

static uint32_t below(uint32_t count)
{
  chance ^= chance << 13;
  chance ^= chance >> 17;
  chance ^= chance << 5;
  return chance % count;
}

bool xrce_session_send(xrce_session_t * sender, const uint8_t * message, size_t size)
{
  (void)sender;
  (void)message;
  (void)size;
  return below(4) != 0u;
}

uint32_t xrce_session_pause(uint32_t wanted_ms)
{
  return wanted_ms;
}

static void forget(uint32_t place)
{
  CHECK(place < stored_count);
  --stored_count;
  memmove(&stored[place], &stored[place + 1u], (stored_count - place) * sizeof(stored[0]));
}

static void write_one(void)
{
  uint8_t * room = xrce_stream_reliable_reserve(&stream, &session);

  if (room == NULL) {
    const uint8_t * dropped = xrce_stream_reliable_drop_oldest(&stream, &session, now_ms);
    uint32_t number;
    uint32_t place = 0;

    if (dropped == NULL) {
      return;
    }
    memcpy(&number, dropped, sizeof(number));
    while (place < stored_count && stored[place] != number) {
      ++place;
    }
    forget(place);
    ++drops;
    room = xrce_stream_reliable_reserve(&stream, &session);
    CHECK(room != NULL);
  }
  memset(room, 0, SIZE);
  memcpy(room, &written, sizeof(written));
  stored[stored_count] = written;
  ++stored_count;
  ++written;
  xrce_stream_reliable_commit(
    &stream, &session, below(2) == 0u ? (size_t)SIZE : sizeof(written) + below(SIZE - 4u), now_ms);
}

static void acknowledge(void)
{
  const uint16_t expected = (uint16_t)(stream.first + below(17));
  const uint32_t before = stream.count;
  uint8_t payload[XRCE_ACKNACK_SIZE];

  xrce_put_le16(&payload[0], expected);
  xrce_put_be16(&payload[2], (uint16_t)below(65536));
  payload[4] = XRCE_STREAM_RELIABLE;
  CHECK(xrce_stream_reliable_on_acknack(
    &stream, &session, payload, sizeof(payload), XRCE_FLAG_LITTLE_ENDIAN, now_ms));
  for (uint32_t i = stream.count; i < before; ++i) {
    later += stored[0] >= marked_end ? 1u : 0u;
    forget(0);
  }
}

/* CREATEs in the stream take numbers; messages wait for them. */
static void create(void)
{
  if (session.state != XRCE_READY) {
    return;
  }
  if (stream.held) {
    stream.first = (uint16_t)(stream.first + below(3));
  } else if (xrce_stream_reliable_is_idle(&stream)) {
    stream.held = true;
    stream.due_ms = now_ms + 1000u;
  }
}

static void reconnect(void)
{
  if (session.state == XRCE_READY) {
    session.state = XRCE_CONNECTING;
  } else {
    session.state = XRCE_READY;
    ++session.statistics.reconnects;
    ++sessions;
    xrce_stream_reliable_hold(&stream, now_ms);
    if (below(2) == 0u) {
      stream.first = (uint16_t)(0xfff0u + below(16)); /* the numbers soon wrap */
    }
  }
}

static void change(void)
{
  const uint32_t what = below(256);

  if (what < 96u) {
    write_one();
  } else if (what < 160u) {
    acknowledge();
  } else if (what < 163u) {
    reconnect();
  } else if (what < 168u) {
    create();
  } else {
    now_ms += below(40);
    xrce_stream_reliable_step(&stream, &session, below(4) == 0u, now_ms);
  }
  was_held = was_held || stream.held;
  CHECK(stream.count == stored_count);
}

/* It is never over too early. It is over in time: at once where each change is seen and nothing was dropped; otherwise after
 * at most as many later messages as there are slots, counted from a look that followed a new session or a release. */
static bool is_over(xrce_mark_t * mark, bool sees_all)
{
  const bool is_counted = mark->is_counted && mark->session == session.statistics.reconnects;
  const bool found = xrce_stream_reliable_has_passed(&stream, &session, mark);
  const bool expected = stored_count == 0u || stored[0] >= marked_end;

  CHECK(expected || !found);
  if (drops == 0u && (sees_all || (sessions == 0u && !was_held))) {
    CHECK(expected == found);
  }
  if (!is_counted) {
    later = 0;
  }
  CHECK(found || later < (uint32_t)NUMBERS);
  return found;
}

static uint32_t await(bool sees_all)
{
  xrce_mark_t mark = xrce_mark_new();

  marked_end = written;
  later = 0;
  sessions = 0;
  drops = 0;
  was_held = stream.held;
  if (is_over(&mark, sees_all)) {
    return 0;
  }
  for (uint32_t i = 0; i < (uint32_t)STEPS; ++i) {
    change();
    if ((sees_all || below(8) == 0u) && is_over(&mark, sees_all)) {
      return sessions + 1u;
    }
  }
  return 0;
}

int main(int argc, char ** argv)
{
  uint32_t ended[3] = {0, 0, 0};

  CHECK(argc == 2);
  chance = (uint32_t)strtoul(argv[1], NULL, 10) * 2654435761u + 1u;
  session.transport_open = true;
  session.state = XRCE_READY;
  stream.first = 0xfffe;
  for (uint32_t i = 0; i < (uint32_t)WAITS; ++i) {
    const uint32_t ends = await(below(2) == 0u);

    ++ended[ends < 2u ? ends : 2u];
    for (uint32_t steps = below(30); steps != 0u; --steps) {
      change();
    }
  }
  CHECK(ended[1] > WAITS / 10 && ended[2] > WAITS / 100); /* within a session, and after another one */
  return 0;
}
