/* SPDX-License-Identifier: Apache-2.0 */
/* The reliable input stream by itself, between an agent that is simulated here and a list of what it handed on. */
#include "unit.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#include <string.h>

enum { MESSAGES = 300, MESSAGE = 10, WINDOW = 16, ACKNACK_MESSAGE = 13 };

static xrce_client_t client;
static uint32_t random_state;
static uint16_t handed_on[2 * MESSAGES]; /* the numbers that the messages carry, in the order of handing on */
static size_t handed_on_count;
static uint16_t expected; /* of the last ACKNACK */
static uint16_t missing;
static uint32_t acknacks;

/* Replaces the session: a delivered message carries its number after the header. */
bool xrce_session_take_submessages(xrce_client_t * taker, const uint8_t * message, size_t size, uint32_t now)
{
  CHECK(taker == &client && now == 5u && size == MESSAGE && handed_on_count < 2 * MESSAGES);
  handed_on[handed_on_count] = xrce_get_le16(&message[8]);
  ++handed_on_count;
  return true;
}

bool xrce_session_send(xrce_session_t * session, const uint8_t * message, size_t size)
{
  static const uint8_t begin[] = {0x81, 0, 0, 0, 0x0a, 1, 5, 0};

  CHECK(session == &client.session && size == ACKNACK_MESSAGE);
  CHECK(memcmp(message, begin, sizeof(begin)) == 0 && message[12] == 0x80u);
  expected = xrce_get_le16(&message[8]);
  missing = xrce_get_be16(&message[10]);
  ++acknacks;
  return true;
}

static uint32_t random_below(uint32_t limit)
{
  random_state = random_state * 1664525u + 1013904223u;
  return (random_state >> 16) % limit;
}

static void begin_at(uint16_t next)
{
  memset(&client, 0, sizeof(client));
  client.session.state = XRCE_READY;
  client.reliable_input.next = next;
  handed_on_count = 0;
  acknacks = 0;
}

static bool take_a_part(uint16_t sequence, uint16_t number, size_t size)
{
  uint8_t message[MESSAGE] = {0x81, 0x80, 0, 0, 0x09, 0x01, MESSAGE - 8, 0};

  xrce_put_le16(&message[2], sequence);
  xrce_put_le16(&message[8], number);
  return xrce_stream_reliable_input_take(&client, message, size, 5);
}

static bool take(uint16_t sequence, uint16_t number)
{
  return take_a_part(sequence, number, MESSAGE);
}

static bool heartbeat(uint16_t first, uint16_t last)
{
  uint8_t payload[5];

  xrce_put_le16(&payload[0], first);
  xrce_put_le16(&payload[2], last);
  payload[4] = 0x80;
  if (!xrce_stream_reliable_input_on_heartbeat(&client, payload, sizeof(payload), 1)) {
    return false;
  }
  xrce_stream_reliable_input_continue(&client, 5);
  return true;
}

static void test_in_order_and_twice(void)
{
  begin_at(0xffff);
  CHECK(take(0xffff, 1) && acknacks == 1u && expected == 0u && missing == 0u);
  CHECK(take(0, 2) && acknacks == 2u && expected == 1u);
  CHECK(
    take(0xffff, 1) && acknacks == 3u && expected == 1u &&
    missing == 0u); /* acknowledged, handed on no more */
  CHECK(handed_on_count == 2u && handed_on[0] == 1u && handed_on[1] == 2u);
}

static void test_a_gap(void)
{
  begin_at(10);
  CHECK(take(12, 12) && expected == 10u && handed_on_count == 0u);
  CHECK(missing == 0x0003u); /* 12 is here, or had no slot: it would find none now */
  CHECK(take(10, 10) && expected == 11u);
  CHECK(missing == (MICROROS_RELIABLE_INPUT_SLOTS > 1u ? 0u : 0x0002u)); /* 11 was requested */
  CHECK(take(11, 11) && missing == 0u);
  CHECK(expected == (MICROROS_RELIABLE_INPUT_SLOTS > 1u ? 13u : 12u));
  CHECK(handed_on_count == (MICROROS_RELIABLE_INPUT_SLOTS > 1u ? 3u : 2u));
}

/* However many messages follow a gap, a missing one is requested once until the next HEARTBEAT. */
static void test_requested_once(void)
{
  uint32_t requested[WINDOW] = {0};

  begin_at(0xfff8);
  for (uint16_t round = 0; round < 3u; ++round) {
    for (uint16_t i = 0; i < WINDOW; ++i) {
      if (i != 0u && i != 5u) {
        CHECK(take((uint16_t)(0xfff8u + i), i) && expected == 0xfff8u);
        for (uint32_t bit = 0; bit < WINDOW; ++bit) {
          requested[bit] += (uint32_t)missing >> bit & 1u;
        }
      }
    }
  }
  for (uint32_t i = 0; i < WINDOW; ++i) {
    CHECK(requested[i] == (i == 0u || i == 5u ? 1u : 0u));
  }
  CHECK(heartbeat(0xfff8, 7) && (missing & 0x21u) == 0x21u); /* the request or its answer was lost */
  CHECK(take(0xfff9, 1) && missing == 0u);
}

/* Somebody forges a number that the agent has not sent: a HEARTBEAT puts it right, nothing more is requested. */
static void test_forged_number(void)
{
  begin_at(0);
  CHECK(take(15, 15) && missing == 0x7fffu);
  for (uint32_t i = 0; i < 5u; ++i) {
    CHECK(take(15, 15) && missing == 0u);
    CHECK(heartbeat(0, 1) && expected == 0u && missing == 3u);
    CHECK(take(15, 15) && missing == 0x7ffcu);
  }
  CHECK(take(0, 0) && take(1, 1) && handed_on_count == 2u && expected == 2u);
}

/* A message without a slot is requested when its turn is near, not while it would find none again. */
static void test_refused_until_the_gap_is_closed(void)
{
  const uint16_t slots = MICROROS_RELIABLE_INPUT_SLOTS - 1u;
  uint32_t requested = 0;

  begin_at(0);
  for (uint16_t i = 1; i < WINDOW; ++i) {
    CHECK(take(i, i) && missing == (i == 1u ? 1u : 0u));
  }
  CHECK(take(0, 0) && expected == slots + 1u);
  for (uint32_t bit = 0; bit < WINDOW; ++bit) {
    requested += (uint32_t)missing >> bit & 1u;
  }
  CHECK(requested == (uint32_t)(WINDOW - 1 - slots));
  for (uint16_t i = (uint16_t)(slots + 1u); i < WINDOW; ++i) {
    CHECK(take(i, i) && missing == 0u);
  }
  CHECK(handed_on_count == WINDOW);
}

static void test_heartbeats(void)
{
  begin_at(0xfffe);
  CHECK(heartbeat(0xfffe, 0) && acknacks == 1u && expected == 0xfffeu && missing == 0x0007u);
  CHECK(heartbeat(0xfffe, 0xfffd) && missing == 0u);      /* an empty range */
  CHECK(heartbeat(0xfffe, 0x7000) && missing == 0xffffu); /* more than the bitmap has */
  CHECK(take(0xffff, 7) && handed_on_count == 0u);
  acknacks = 0;
  /* up to the retained messages, which are delivered after the HEARTBEAT's message, not from within it */
  CHECK(heartbeat(2, 3) && expected == (MICROROS_RELIABLE_INPUT_SLOTS > 1u ? 0u : 2u) && acknacks == 1u);
  CHECK(heartbeat(2, 3) && expected == 2u && (missing & 3u) == 3u && acknacks == 2u);
  CHECK(handed_on_count == (MICROROS_RELIABLE_INPUT_SLOTS > 1u ? 1u : 0u)); /* what is here is not lost */
  CHECK(heartbeat(1, 3) && expected == 2u);                                 /* no way back */
  CHECK(!heartbeat(2 + WINDOW + 1, 40) && expected == 2u); /* of another session: it moves nothing */
  CHECK(!heartbeat(0x8001, 0x8002) && expected == 2u);
  CHECK(heartbeat(2 + WINDOW, 1 + WINDOW) && expected == 2u + WINDOW && missing == 0u);
  CHECK(take(2, 2) && take(2 + 2 * WINDOW, 3)); /* old, and beyond the window */
  CHECK(expected == 2u + WINDOW && missing == 0u);
  CHECK(handed_on_count == (MICROROS_RELIABLE_INPUT_SLOTS > 1u ? 1u : 0u));
}

static void test_what_is_not_for_it(void)
{
  uint8_t payload[5] = {0, 9, 0, 9, 0x81};
  uint8_t other[MESSAGE] = {0x81, 0x81};

  begin_at(0);
  CHECK(!xrce_stream_reliable_input_take(&client, other, sizeof(other), 5) && acknacks == 0u);
  CHECK(xrce_stream_reliable_input_on_heartbeat(&client, payload, 5, 1) && acknacks == 0u);
  CHECK(!xrce_stream_reliable_input_on_heartbeat(&client, payload, 4, 1));
  payload[4] = 0x80;
  client.session.state = XRCE_CONNECTING;
  CHECK(xrce_stream_reliable_input_on_heartbeat(&client, payload, 5, 1) && take(0, 0));
  CHECK(acknacks == 0u && client.reliable_input.next == 0u);
  client.session.state = XRCE_READY;
  CHECK(xrce_stream_reliable_input_on_heartbeat(&client, payload, 5, 0) && expected == 9u); /* big endian */
}

static void test_what_was_cut_has_not_come(void)
{
  begin_at(0);
  for (size_t size = 4; size < MESSAGE; ++size) {
    CHECK(!take_a_part(0, 1, size) && !take_a_part(1, 2, size) && acknacks == 0u);
  }
  CHECK(handed_on_count == 0u && client.reliable_input.announced == 0u);
  CHECK(take(0, 1) && expected == 1u && missing == 0u && handed_on_count == 1u);
  xrce_stream_reliable_input_reset(&client.reliable_input);
  CHECK(client.reliable_input.next == 0u && client.reliable_input.announced == 0u);
}

/* A sender with a window of 16 and a network that loses, doubles and reorders: what it sends is handed on in order. */
static void test_rough_network(uint32_t seed)
{
  const uint16_t start = (uint16_t)(0xff80u + seed);
  uint16_t acknowledged = 0; /* messages, as the sender knows */

  random_state = seed;
  begin_at(start);
  for (uint32_t round = 0; acknowledged < MESSAGES; ++round) {
    const uint16_t ahead = (uint16_t)random_below(WINDOW);
    const uint16_t number = (uint16_t)(acknowledged + ahead);

    CHECK(round < 100u * MESSAGES);
    if (number < MESSAGES && random_below(5) != 0u) {
      CHECK(take((uint16_t)(start + number), number));
    }
    if (random_below(8) == 0u) {
      const uint16_t end =
        acknowledged + WINDOW < MESSAGES ? (uint16_t)(acknowledged + WINDOW) : (uint16_t)MESSAGES;

      CHECK(heartbeat((uint16_t)(start + acknowledged), (uint16_t)(start + end - 1u)));
      if ((missing & 1u) != 0u) {
        CHECK(take(expected, (uint16_t)(expected - start)));
      }
    }
    if (random_below(3) != 0u) { /* else the ACKNACK is lost */
      acknowledged = (uint16_t)(client.reliable_input.next - start);
    }
  }
  CHECK(handed_on_count == MESSAGES);
  for (size_t i = 0; i < MESSAGES; ++i) {
    CHECK(handed_on[i] == i);
  }
}

int main(void)
{
  test_in_order_and_twice();
  test_a_gap();
  test_requested_once();
  test_forged_number();
  test_refused_until_the_gap_is_closed();
  test_heartbeats();
  test_what_is_not_for_it();
  test_what_was_cut_has_not_come();
  for (uint32_t seed = 0; seed < 200u; ++seed) {
    test_rough_network(seed);
  }
  return 0;
}
