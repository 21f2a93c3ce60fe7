/* SPDX-License-Identifier: Apache-2.0 */
/* The reliable stream by itself: the ring, the wrap of sequence numbers, ACKNACKs old and wrong. Four slots.
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

static void test_wrap(void)
{
  begin_at(0xfffe);
  for (int i = 0; i < 4; ++i) {
    write_one();
  }
  CHECK(xrce_stream_reliable_reserve(&stream, &session) == NULL);
  CHECK(session.statistics.sent == 4u);
  for (uint8_t i = 0; i < 4u; ++i) {
    CHECK(number_of(i) == (uint16_t)(0xfffeu + i));
  }
  acknack(0xffff, 0x0003); /* ffff and 0000 are missing */
  CHECK(stream.count == 3u && stream.first == 0xffffu);
  CHECK(session.statistics.resent == 2u && session.statistics.sent == 4u);
  xrce_stream_reliable_step(&stream, &session, true, 0);
  CHECK(session.statistics.sent == 6u);
  acknack(1, 0);
  CHECK(stream.count == 1u && stream.first == 1u);
  acknack(2, 0);
  CHECK(stream.count == 0u && stream.first == 2u);
}

static void test_many_rounds(void)
{
  begin_at(0);
  for (uint32_t i = 0; i < 200000u; ++i) {
    write_one();
    CHECK(stream.count <= 4u);
    if (i % 3u == 2u) {
      acknack((uint16_t)(stream.first + stream.count), 0);
      CHECK(stream.count == 0u && stream.first == (uint16_t)(i + 1u));
    }
  }
}

static void test_old_and_wrong_acknacks(void)
{
  begin_at(10);
  write_one();
  write_one();
  acknack(9, 0);  /* older than what was acknowledged */
  acknack(13, 0); /* more than was sent */
  acknack(0x8009, 0);
  CHECK(stream.count == 2u && stream.first == 10u && session.statistics.resent == 0u);
  acknack(10, 0xffff); /* bits beyond the last */
  CHECK(session.statistics.resent == 2u && stream.count == 2u);
  xrce_stream_reliable_step(&stream, &session, true, 0);
  acknack(8, 0x0004); /* 8 + 2 is the first of ours */
  acknack(8, 0x0004); /* and it is on its way already */
  CHECK(session.statistics.resent == 3u);
}

static void test_other_streams_and_short_payloads(void)
{
  uint8_t payload[5] = {11, 0, 0, 0, 0x81};

  begin_at(10);
  write_one();
  CHECK(xrce_stream_reliable_on_acknack(&stream, &session, payload, 5, XRCE_FLAG_LITTLE_ENDIAN, 0));
  CHECK(stream.count == 1u);
  CHECK(!xrce_stream_reliable_on_acknack(&stream, &session, payload, 4, XRCE_FLAG_LITTLE_ENDIAN, 0));
  payload[4] = XRCE_STREAM_RELIABLE;
  session.state = XRCE_CONNECTING;
  CHECK(xrce_stream_reliable_on_acknack(&stream, &session, payload, 5, XRCE_FLAG_LITTLE_ENDIAN, 0));
  CHECK(stream.count == 1u);
}

static void test_a_new_session_numbers_from_zero(void)
{
  begin_at(700);
  write_one();
  write_one();
  xrce_stream_reliable_hold(&stream, 0);
  CHECK(stream.first == 0u);
  write_one();
  CHECK(session.statistics.sent == 2u); /* held back */
  xrce_stream_reliable_step(&stream, &session, false, MICROROS_CREATE_TIMEOUT_MS - 1u);
  CHECK(session.statistics.sent == 2u);
  xrce_stream_reliable_step(&stream, &session, true, MICROROS_CREATE_TIMEOUT_MS - 1u);
  CHECK(session.statistics.sent == 5u && !stream.held);
  CHECK(number_of(0) == 0u && number_of(2) == 2u);
}

/* `creation: reliable` takes numbers while the stream is held. */
static void test_what_is_held_is_numbered_behind_the_requests(void)
{
  begin_at(700);
  write_one();
  write_one();
  write_one();
  xrce_stream_reliable_hold(&stream, 0);
  stream.first = 3;
  xrce_stream_reliable_step(&stream, &session, true, 1);
  CHECK(session.statistics.sent == 6u && stream.first == 3u);
  CHECK(number_of(0) == 3u && number_of(2) == 5u);
}

int main(void)
{
  test_wrap();
  test_many_rounds();
  test_old_and_wrong_acknacks();
  test_other_streams_and_short_payloads();
  test_a_new_session_numbers_from_zero();
  test_what_is_held_is_numbered_behind_the_requests();
  return 0;
}
