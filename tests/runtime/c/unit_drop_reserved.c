/* SPDX-License-Identifier: Apache-2.0 */
/* `on_full: drop_oldest` while slots of the stream are reserved for replies. Four slots.
 */
#include "unit.h"

#include "microros/rmw_client.h"
#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"

#include <string.h>

enum { SLOTS = 4, SIZE = 16 };

static xrce_endpoint_t writer;

static void put(uint8_t * room)
{
  memset(room, 0, SIZE);
  xrce_put_be16(&room[XRCE_SUBMESSAGE_HEADER + 2], xrce_object_id(0, XRCE_KIND_DATAWRITER));
  CHECK(xrce_route_commit(writer.client, true, SIZE));
}

/* A stream with `count` messages, of which as many were sent as may be, and slots reserved afterwards. */
static xrce_client_t * begin(uint8_t count, uint8_t replies_due)
{
  xrce_client_t * client = rmw_client_instance();

  memset(&client->reliable, 0, sizeof(client->reliable));
  memset(&client->session.statistics, 0, sizeof(client->session.statistics));
  client->session.state = XRCE_READY;
  client->session.transport_open = true;
  client->replies_due = 0;
  memset(&writer, 0, sizeof(writer));
  writer.client = client;
  writer.qos = XRCE_QOS_RELIABLE;
  for (uint8_t i = 0; i < count; ++i) {
    uint8_t * room = xrce_route_reserve(client, true);

    CHECK(room != NULL);
    put(room);
  }
  client->replies_due = replies_due;
  return client;
}

static uint32_t dropped(const xrce_client_t * client)
{
  return client->session.statistics.dropped;
}

static void test_a_new_one_replaces_what_waits(void)
{
  xrce_client_t * client = begin(SLOTS, 0);
  uint8_t * room = NULL;

  CHECK(xrce_write_on_full(&writer, &room) == XRCE_WRITTEN && room != NULL);
  CHECK(client->reliable.count == SLOTS - 1u && dropped(client) == 1u);
}

/* Replies have all slots: what is stored stays, and the new message is refused. */
static void test_nothing_is_dropped_for_slots_that_replies_get(void)
{
  for (uint8_t due = SLOTS; due <= SLOTS + 1; ++due) {
    xrce_client_t * client = begin(SLOTS, due);
    uint8_t * room = NULL;

    CHECK(xrce_write_on_full(&writer, &room) != XRCE_WRITTEN && room == NULL);
    CHECK(client->reliable.count == SLOTS && client->reliable.sent == SLOTS - 1u && !client->reliable.gap);
    CHECK(dropped(client) == 1u); /* the new one */
  }
}

/* What waits makes room for the reply. What was sent stays, and leaves no gap. */
static void test_what_was_sent_stays(void)
{
  for (uint8_t due = 1; due < SLOTS; ++due) {
    xrce_client_t * client = begin(SLOTS, due);
    uint8_t * room = NULL;

    CHECK(xrce_write_on_full(&writer, &room) != XRCE_WRITTEN && room == NULL);
    CHECK(client->reliable.count == SLOTS - 1u && client->reliable.sent == SLOTS - 1u);
    CHECK(client->reliable.first == 0u && !client->reliable.gap && dropped(client) == 2u);
    CHECK(xrce_write_on_full(&writer, &room) != XRCE_WRITTEN && dropped(client) == 3u);
    CHECK(client->reliable.count == SLOTS - 1u);
    client->replies_due = 0; /* the first reply takes its slot */
    room = xrce_route_reserve(client, true);
    CHECK(room != NULL);
    put(room);
    CHECK(client->reliable.count == SLOTS);
  }
}

/* Without a session nothing is under way: the newest ones stay. */
static void test_without_a_session_the_oldest_go(void)
{
  xrce_client_t * client = begin(SLOTS, 2);
  uint8_t * room = NULL;

  client->session.state = XRCE_CONNECTING;
  CHECK(xrce_write_on_full(&writer, &room) == XRCE_WRITTEN && room != NULL);
  CHECK(client->reliable.count == 1u && dropped(client) == 3u);
}

int main(void)
{
  test_a_new_one_replaces_what_waits();
  test_nothing_is_dropped_for_slots_that_replies_get();
  test_what_was_sent_stays();
  test_without_a_session_the_oldest_go();
  return 0;
}
