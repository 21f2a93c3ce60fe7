/* SPDX-License-Identifier: Apache-2.0 */
/* The reliable stream of `on_full: drop_oldest` by itself. Four slots.
 */
#include "unit.h"

#include "microros/xrce_client.h"
#include "microros/xrce_stream_reliable_slots.h"
#include "microros/xrce_wire.h"

#include <string.h>

static xrce_session_t session;
static xrce_stream_reliable_t stream;
static uint8_t * slots; /* of the stream: in one array */

static void begin_at(uint16_t first)
{
  memset(&session, 0, sizeof(session));
  session.state = XRCE_READY;
  session.transport_open = true;
  memset(&stream, 0, sizeof(stream));
  memset(&xrce_reliable_slots, 0, sizeof(xrce_reliable_slots));

  slots = xrce_stream_reliable_reserve(&stream, &session) - MICROROS_RELIABLE_FRONT;
  stream.first = first;
}

/* Returns the sequence number in a slot. */
static uint16_t number_of(size_t slot)
{
  return xrce_get_le16(&slots[slot * MICROROS_RELIABLE_SLOT_SIZE + 2u]);
}

static void write_one(void)
{
  uint8_t * room = xrce_stream_reliable_reserve(&stream, &session);

  CHECK(room != NULL);
  memset(room, 0xab, MICROROS_RELIABLE_SLOT_SIZE - XRCE_MESSAGE_HEADER);
  xrce_stream_reliable_commit(&stream, &session, MICROROS_RELIABLE_SLOT_SIZE - XRCE_MESSAGE_HEADER, 0);
}

static void acknack(uint16_t expected, uint16_t missing)
{
  uint8_t payload[5];

  xrce_put_le16(&payload[0], expected);
  xrce_put_be16(&payload[2], missing);
  payload[4] = XRCE_STREAM_RELIABLE;
  CHECK(xrce_stream_reliable_on_acknack(&stream, &session, payload, 5, XRCE_FLAG_LITTLE_ENDIAN, 0));
}

static void test_the_first_ones_are_sent_and_one_slot_waits(void)
{
  begin_at(0xfffe);
  for (int i = 0; i < 4; ++i) {
    write_one();
  }
  CHECK(xrce_stream_reliable_reserve(&stream, &session) == NULL);
  CHECK(session.statistics.sent == 3u && stream.sent == 3u && stream.count == 4u);
  for (uint8_t i = 0; i < 3u; ++i) {
    CHECK(number_of(i) == (uint16_t)(0xfffeu + i));
  }
  CHECK(!xrce_stream_reliable_is_blocked(&stream)); /* the transport has nothing to do with it */
  acknack(0xffff, 0x0003);                          /* ffff and 0000 are missing */
  CHECK(stream.count == 3u && stream.first == 0xffffu && session.statistics.resent == 2u);
  acknack(0xffff, 0x0003); /* each is repeated once */
  CHECK(session.statistics.resent == 2u && xrce_stream_reliable_is_blocked(&stream));
  xrce_stream_reliable_step(&stream, &session, true, 0);
  CHECK(
    session.statistics.sent == 7u); /* both, the one that waited, and a HEARTBEAT: nothing else would tell */
  CHECK(number_of(3) == 1u);
  acknack(2, 0);
  CHECK(stream.count == 0u && stream.sent == 0u && stream.first == 2u);
}

static void test_many_rounds(void)
{
  begin_at(0);
  for (uint32_t i = 0; i < 200000u; ++i) {
    write_one();
    CHECK(stream.count <= 3u && stream.sent == stream.count);
    if (i % 3u == 2u) {
      acknack((uint16_t)(stream.first + stream.count), 0);
      CHECK(stream.count == 0u && stream.first == (uint16_t)(i + 1u));
    }
  }
}

static void test_old_and_wrong_acknacks(void)
{
  uint8_t payload[5] = {11, 0, 0, 0, 0x81};

  begin_at(10);
  write_one();
  write_one();
  acknack(9, 0);  /* older than what was acknowledged */
  acknack(13, 0); /* more than was sent */
  acknack(0x8009, 0);
  CHECK(stream.count == 2u && stream.first == 10u && session.statistics.resent == 0u && !stream.gap);
  acknack(10, 0xffff); /* bits beyond the last */
  CHECK(session.statistics.resent == 2u && stream.count == 2u);
  CHECK(xrce_stream_reliable_on_acknack(&stream, &session, payload, 5, XRCE_FLAG_LITTLE_ENDIAN, 0));
  CHECK(!xrce_stream_reliable_on_acknack(&stream, &session, payload, 4, XRCE_FLAG_LITTLE_ENDIAN, 0));
  payload[4] = XRCE_STREAM_RELIABLE;
  session.state = XRCE_CONNECTING;
  CHECK(xrce_stream_reliable_on_acknack(&stream, &session, payload, 5, XRCE_FLAG_LITTLE_ENDIAN, 0));
  CHECK(stream.count == 2u);
}

/* Nobody has seen a number of what is dropped: the next one takes it. */
static void test_what_waits_is_replaced(void)
{
  const uint8_t * waits;

  begin_at(0xffff);
  CHECK(xrce_stream_reliable_drop_oldest(&stream, &session, 0) == NULL);
  for (int i = 0; i < 4; ++i) {
    write_one();
  }
  waits = &slots[3u * MICROROS_RELIABLE_SLOT_SIZE + MICROROS_RELIABLE_FRONT];
  for (int i = 0; i < 9; ++i) {
    CHECK(xrce_stream_reliable_drop_oldest(&stream, &session, 5) == waits);
    CHECK(stream.first == 0xffffu && stream.count == 3u && stream.sent == 3u && !stream.gap);
    write_one();
  }
  CHECK(session.statistics.sent == 3u);
  acknack(2, 0);
  xrce_stream_reliable_step(&stream, &session, true, 6);
  CHECK(session.statistics.sent == 4u && number_of(3) == 2u);
}

/* Slots are kept free for replies: all that is stored was sent. */
static void test_what_was_sent_stays(void)
{
  begin_at(0xffff);
  write_one();
  write_one();
  CHECK(xrce_stream_reliable_drop_oldest(&stream, &session, 5) == NULL);
  CHECK(stream.first == 0xffffu && stream.count == 2u && stream.sent == 2u && !stream.gap);
  acknack(0xfffe, 1); /* of before: the agent waits for what is gone */
  CHECK(stream.gap && xrce_stream_reliable_is_blocked(&stream) && session.statistics.resent == 0u);
  session.transport_open = false; /* it accepts nothing */
  xrce_stream_reliable_step(&stream, &session, true, 5);
  CHECK(stream.gap && session.statistics.sent == 2u);
  session.transport_open = true;
  write_one(); /* the HEARTBEAT first */
  CHECK(!stream.gap && session.statistics.sent == 4u && number_of(2) == 1u);
}

static void test_a_new_session_numbers_from_zero(void)
{
  begin_at(700);
  write_one();
  write_one();
  session.state = XRCE_CONNECTING;
  CHECK(xrce_stream_reliable_drop_oldest(&stream, &session, 0) == &slots[MICROROS_RELIABLE_FRONT]);
  CHECK(stream.count == 1u && stream.sent == 0u && !stream.gap);
  write_one();
  session.state = XRCE_READY;
  xrce_stream_reliable_hold(&stream, 0);
  CHECK(stream.first == 0u);
  write_one();
  CHECK(session.statistics.sent == 2u); /* held back */
  stream.first = 3;                     /* `creation: reliable` takes numbers meanwhile */
  CHECK(xrce_stream_reliable_drop_oldest(&stream, &session, 0) && stream.first == 3u && stream.count == 2u);
  xrce_stream_reliable_step(&stream, &session, false, MICROROS_CREATE_TIMEOUT_MS - 1u);
  CHECK(session.statistics.sent == 2u);
  xrce_stream_reliable_step(&stream, &session, true, MICROROS_CREATE_TIMEOUT_MS - 1u);
  CHECK(session.statistics.sent == 4u && !stream.held && stream.first == 3u && stream.sent == 2u);
}

int main(void)
{
  test_the_first_ones_are_sent_and_one_slot_waits();
  test_many_rounds();
  test_old_and_wrong_acknacks();
  test_what_waits_is_replaced();
  test_what_was_sent_stays();
  test_a_new_session_numbers_from_zero();
  return 0;
}
