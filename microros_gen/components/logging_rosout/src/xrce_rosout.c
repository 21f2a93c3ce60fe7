/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_rosout.h"

#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_turn.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"
#include "rcl_interfaces/msg/log.h"

#include <stddef.h>

enum {
  LINE_HEADER = 2,
  LINE_MOST = rcl_interfaces__msg__Log__MAX_ENCODED_SIZE,
  BODY_OFFSET = XRCE_SUBMESSAGE_HEADER + XRCE_OBJECT_PREFIX
};

/* A ring: each line is its size, high byte first, and the body. */
static uint8_t rosout_lines[MICROROS_LOG_ROSOUT_SIZE];
static uint32_t rosout_first;
static uint32_t rosout_used;
static const xrce_endpoint_t * rosout_writer;

static uint32_t rosout_at(uint32_t index)
{
  const uint32_t room = MICROROS_LOG_ROSOUT_SIZE - rosout_first;

  return index < room ? rosout_first + index : index - room;
}

static void rosout_append(uint8_t byte)
{
  rosout_lines[rosout_at(rosout_used)] = byte;
  ++rosout_used;
}

static uint32_t rosout_line_size(void)
{
  return (uint32_t)rosout_lines[rosout_at(0u)] << 8 | rosout_lines[rosout_at(1u)];
}

/* What has to be sent must not wait for the next message: whoever sends looks again. Without a session nothing can be. */
static void rosout_notify(void)
{
  if (rosout_writer != NULL) {
    xrce_turn_stored(rosout_writer->client);
  }
}

void xrce_rosout_use(const xrce_endpoint_t * writer)
{
  rosout_writer = writer;
  rosout_notify(); /* of the lines that have waited for it */
}

/* A new session has no writers until their nodes are open again. */
bool xrce_rosout_is_open(const xrce_client_t * client)
{
  return rosout_writer != NULL && rosout_writer->client == client;
}

const xrce_client_t * xrce_rosout_client(void)
{
  return rosout_writer == NULL ? NULL : rosout_writer->client;
}

bool xrce_rosout_put(const uint8_t * body, uint32_t size)
{
  if (LINE_HEADER + size > MICROROS_LOG_ROSOUT_SIZE - rosout_used) {
    return false;
  }
  rosout_append((uint8_t)(size >> 8));
  rosout_append((uint8_t)(size & 0xffu));
  /* at most LINE_MOST rounds, MICROROS_LOG_ROSOUT_SIZE in each microros_ring_step */
  for (uint32_t i = 0; i < size; ++i) {
    rosout_append(body[i]);
  }
  rosout_notify();
  return true;
}

bool xrce_rosout_has_room(uint32_t size)
{
  return rosout_used == 0u || 2u * (LINE_HEADER + size) <= MICROROS_LOG_ROSOUT_SIZE - rosout_used;
}

/* Writes the oldest line into the room of the stream, and removes it. Returns the size of the submessage. */
static uint32_t rosout_move(uint8_t * room)
{
  const uint32_t size = rosout_line_size();

  xrce_put_submessage(
    room, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)((uint32_t)XRCE_OBJECT_PREFIX + size));
  xrce_put_be16(&room[4], XRCE_REQUEST_NONE);
  xrce_put_be16(&room[6], xrce_object_id(rosout_writer->index, XRCE_KIND_DATAWRITER));
  /* at most LINE_MOST rounds, MICROROS_LOG_ROSOUT_SIZE in each xrce_rosout_send */
  for (uint32_t i = 0; i < size; ++i) {
    room[(uint32_t)BODY_OFFSET + i] = rosout_lines[rosout_at(LINE_HEADER + i)];
  }
  rosout_first = rosout_at(LINE_HEADER + size);
  rosout_used -= LINE_HEADER + size;
  return (uint32_t)BODY_OFFSET + size;
}

void xrce_rosout_send(const xrce_client_t * client)
{
  if (!xrce_rosout_is_open(client)) {
    return;
  }
  /* at most MICROROS_RELIABLE_SLOTS rounds */
  while (rosout_used != 0u && xrce_route_unacknowledged(client) < (MICROROS_RELIABLE_SLOTS + 1u) / 2u) {
    uint8_t * const room = xrce_write_reserve(rosout_writer);

    if (room == NULL) {
      return;
    }
    /* Cannot fail: a reliable stream keeps what it has until it is acknowledged. */
    (void)xrce_route_commit(rosout_writer->client, true, (size_t)rosout_move(room));
  }
}
