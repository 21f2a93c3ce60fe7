/* SPDX-License-Identifier: Apache-2.0 */
/* CREATE with binary representation (OMG DDS-XRCE 1.0, 7.7.3), as messages of the best-effort stream. */
#include "microros/xrce_entities_binary.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#include <string.h>

enum { FORMAT_BINARY = 0x03 };

/* Writes within a room; `overflow` stays set once something did not fit. */
typedef struct room_t {
  uint8_t * bytes;
  size_t used;
  size_t capacity;
  bool overflow;
} room_t;

static void room_put(room_t * room, const void * data, size_t size)
{
  if (size > room->capacity - room->used) {
    room->overflow = true;
    return;
  }
  memcpy(&room->bytes[room->used], data, size);
  room->used += size;
}

static void room_put_byte(room_t * room, uint8_t value)
{
  room_put(room, &value, 1);
}

/* Pads from `origin` on. */
static void room_align(room_t * room, size_t origin, size_t alignment)
{
  while (((room->used - origin) & (alignment - 1u)) != 0u && !room->overflow) {
    room_put_byte(room, 0);
  }
}

static void room_put_u16(room_t * room, uint16_t value)
{
  uint8_t bytes[2];

  xrce_put_le16(bytes, value);
  room_put(room, bytes, sizeof(bytes));
}

static void room_put_id(room_t * room, uint16_t id)
{
  uint8_t bytes[2];

  xrce_put_be16(bytes, id);
  room_put(room, bytes, sizeof(bytes));
}

/* A string of two pieces with one NUL; lengths below 64 KiB, since a message is. */
static void room_put_string(room_t * room, const char * first, const char * second)
{
  const size_t first_size = strlen(first);
  const size_t second_size = strlen(second) + 1u;

  room_put_u16(room, (uint16_t)(first_size + second_size));
  room_put_u16(room, 0);
  room_put(room, first, first_size);
  room_put(room, second, second_size);
}

static void put_participant(room_t * room, const xrce_participant_t * participant)
{
  const size_t name_size = strlen(participant->name) + 1u;
  const size_t namespace_size = participant->namespace_[1] == '\0' ? 0u : strlen(participant->namespace_) + 1u;

  room_put_byte(room, 0); /* no domain reference */
  room_put_byte(room, 1); /* a QoS profile reference: the participant's name */
  room_put_u16(room, 0);
  room_put_u16(room, (uint16_t)(namespace_size + name_size));
  room_put_u16(room, 0);
  if (namespace_size != 0u) {
    room_put(room, participant->namespace_, namespace_size - 1u);
    room_put_byte(room, '/');
  }
  room_put(room, participant->name, name_size);
}

static void put_topic(room_t * room, const xrce_writer_t * writer)
{
  const size_t origin = room->used;

  room_put_string(room, "rt", writer->topic);
  room_put_byte(room, 0); /* no type reference */
  room_put_byte(room, 1); /* a type name */
  room_align(room, origin, 4);
  room_put_string(room, "", writer->type->dds_type_name);
}

static void put_data_writer(room_t * room, const xrce_writer_t * writer)
{
  room_put_id(room, xrce_object_id(writer->index, XRCE_KIND_TOPIC));
  room_put_byte(room, 1); /* QoS */
  room_put_byte(room, 0);
  room_put_u16(room, writer->qos);
  if (writer->depth != 0u) {
    room_put_byte(room, 1);
    room_put_byte(room, 0);
    room_put_u16(room, writer->depth);
  } else {
    room_put_byte(room, 0);
  }
  room_put_u16(room, 0); /* no deadline, no lifespan */
  room_put_u16(room, 0); /* no user data, no ownership strength */
}

/* The blob of one object, and the id of its parent behind it. */
static void put_object(room_t * room, const xrce_client_t * client, uint16_t place, uint8_t kind)
{
  const xrce_writer_t * writer;

  if (kind == XRCE_KIND_PARTICIPANT) {
    put_participant(room, &client->participants[place]);
    return;
  }
  writer = xrce_entities_writer(client, place);
  if (kind == XRCE_KIND_TOPIC) {
    put_topic(room, writer);
  } else if (kind == XRCE_KIND_PUBLISHER) {
    room_put_u16(room, 0); /* neither name nor QoS */
  } else {
    put_data_writer(room, writer);
  }
}

static void put_parent(room_t * room, const xrce_client_t * client, uint16_t place, uint8_t kind)
{
  const xrce_writer_t * writer;

  if (kind == XRCE_KIND_PARTICIPANT) {
    room_align(room, 0, 2);
    room_put_u16(room, client->participants[place].domain_id);
    return;
  }
  writer = xrce_entities_writer(client, place);
  room_put_id(
    room, kind == XRCE_KIND_DATAWRITER ? xrce_object_id(writer->index, XRCE_KIND_PUBLISHER)
                                       : xrce_object_id(writer->participant, XRCE_KIND_PARTICIPANT));
}

static bool send_request(xrce_client_t * client, room_t * room, uint8_t id, uint8_t flags)
{
  xrce_put_submessage(
    room->bytes, id, flags | XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(room->used - XRCE_SUBMESSAGE_HEADER));
  return !room->overflow && xrce_stream_best_effort_commit(&client->best_effort, &client->session, room->used);
}

/* Begins a request: leaves place for the submessage header, then names request and object. */
static room_t begin_request(xrce_client_t * client, uint16_t object)
{
  room_t room = {NULL, XRCE_SUBMESSAGE_HEADER, MICROROS_BEST_EFFORT_SIZE - XRCE_MESSAGE_HEADER, false};

  room.bytes = xrce_stream_best_effort_reserve(&client->best_effort);
  room_put_id(&room, client->entities.request);
  room_put_id(&room, object);
  return room;
}

bool xrce_entities_send_create(xrce_client_t * client, uint16_t place, uint16_t object, uint8_t kind)
{
  room_t room = begin_request(client, object);
  size_t blob;

  room_put_byte(&room, kind);
  room_put_byte(&room, FORMAT_BINARY);
  room_put_u16(&room, 0);
  room_put_u16(&room, 0); /* length, when it is known */
  room_put_u16(&room, 0);
  blob = room.used;
  put_object(&room, client, place, kind);
  if (!room.overflow) {
    xrce_put_le16(&room.bytes[blob - 4u], (uint16_t)(room.used - blob));
  }
  put_parent(&room, client, place, kind);
  (void)send_request(client, &room, XRCE_CREATE, XRCE_FLAG_REUSE | XRCE_FLAG_REPLACE);
  return !room.overflow;
}

void xrce_entities_send_delete(xrce_client_t * client, uint16_t object)
{
  room_t room = begin_request(client, object);

  (void)send_request(client, &room, XRCE_DELETE, 0);
}
