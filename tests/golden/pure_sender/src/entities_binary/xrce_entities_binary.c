/* SPDX-License-Identifier: Apache-2.0 */
/*
 * CREATE with binary representation (OMG DDS-XRCE 1.0, 7.7.3), as messages of the best-effort stream. Names
 * are those that the plan sized the stream for; a type that it does not know is refused before
 * (xrce_entities_fits).
 */
#include "microros/xrce_entities_binary.h"

#include "microros/text.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* Submessage header, request id, object id; then kind, format, padding and the blob's length. */
enum { REQUEST_AT = 4, OBJECT_AT = 6, KIND_AT = 8, LENGTH_AT = 12, BLOB_AT = 16, DELETE_SIZE = 8 };

enum { FORMAT_BINARY = 0x03 };

static const uint8_t writer_kinds[] = {XRCE_KIND_TOPIC, XRCE_KIND_PUBLISHER, XRCE_KIND_DATAWRITER};

const xrce_writer_t * xrce_entities_writer(const xrce_client_t * client, uint16_t place)
{
  return &client->writers[place - MICROROS_NODES_MAX];
}

bool xrce_entities_fits(const xrce_writer_t * writer)
{
  const size_t topic = 4u + sizeof("rt") + microros_text_size(writer->topic) + 2u; /* and two flags */
  const size_t type = 4u + microros_text_size(writer->type->dds_type_name) + 1u;

  return BLOB_AT + ((topic + 3u) & ~(size_t)3u) + type + 2u <=
         MICROROS_BEST_EFFORT_SIZE - XRCE_MESSAGE_HEADER;
}

static uint8_t * put_text(uint8_t * at, const char * text)
{
  while (*text != '\0') {
    *at++ = (uint8_t)*text++;
  }
  return at;
}

/* A string of up to three pieces: its length, the pieces, one NUL. Below 64 KiB, since a message is. */
static uint8_t * put_string(uint8_t * at, const char * first, const char * second, const char * third)
{
  uint8_t * end = put_text(put_text(put_text(&at[4], first), second), third);

  *end++ = 0;
  xrce_put_le16(&at[0], (uint16_t)(end - &at[4]));
  xrce_put_le16(&at[2], 0);
  return end;
}

static uint8_t * put_id(uint8_t * at, uint16_t id)
{
  xrce_put_be16(at, id);
  return &at[2];
}

/* The name is that of a QoS profile; there is no domain reference. Behind the blob the domain, at an even
 * place. */
static uint8_t * put_participant(uint8_t * blob, const xrce_participant_t * participant)
{
  const bool is_root = participant->namespace_[1] == '\0';
  uint8_t * end;

  memset(blob, 0, 4);
  blob[1] = 1;
  end = put_string(&blob[4], is_root ? "" : participant->namespace_, is_root ? "" : "/", participant->name);
  xrce_put_le16(&blob[LENGTH_AT - BLOB_AT], (uint16_t)(end - blob));
  if (((end - blob) & 1) != 0) {
    *end++ = 0;
  }
  xrce_put_le16(end, participant->domain_id);
  return &end[2];
}

/* No type reference, but a type name, padded to four from the blob's begin. */
static uint8_t * put_topic(uint8_t * blob, const xrce_writer_t * writer)
{
  uint8_t * end = put_string(blob, "rt", "", writer->topic);

  *end++ = 0;
  *end++ = 1;
  while (((end - blob) & 3) != 0) {
    *end++ = 0;
  }
  return put_string(end, "", "", writer->type->dds_type_name);
}

/* QoS: flags, depth where there is one; neither deadline, lifespan, user data nor ownership strength. */
static uint8_t * put_data_writer(uint8_t * blob, const xrce_writer_t * writer)
{
  memset(blob, 0, 14);
  xrce_put_be16(&blob[0], xrce_object_id(writer->index, XRCE_KIND_TOPIC));
  blob[2] = 1;
  blob[4] = writer->qos;
  if (writer->depth == 0u) {
    return &blob[11];
  }
  blob[6] = 1;
  xrce_put_le16(&blob[8], writer->depth);
  return &blob[14];
}

/* Behind the blob of a writer's object the id of its parent. */
static uint8_t * put_writer(uint8_t * blob, const xrce_writer_t * writer, uint8_t kind)
{
  uint16_t parent = xrce_object_id(writer->participant, XRCE_KIND_PARTICIPANT);
  uint8_t * end;

  if (kind == XRCE_KIND_TOPIC) {
    end = put_topic(blob, writer);
  } else if (kind == XRCE_KIND_PUBLISHER) {
    end = put_id(blob, 0); /* neither name nor QoS */
  } else {
    end = put_data_writer(blob, writer);
    parent = xrce_object_id(writer->index, XRCE_KIND_PUBLISHER);
  }
  xrce_put_le16(&blob[LENGTH_AT - BLOB_AT], (uint16_t)(end - blob));
  return put_id(end, parent);
}

/* Sends `size` bytes under the outstanding request. A loss is what the repetition is for. */
static void send_request(xrce_client_t * client, uint8_t id, uint8_t flags, uint16_t object, size_t size)
{
  uint8_t * bytes = xrce_stream_best_effort_reserve(&client->best_effort);

  xrce_put_submessage(bytes, id, flags, (uint16_t)(size - XRCE_SUBMESSAGE_HEADER));
  xrce_put_be16(&bytes[REQUEST_AT], client->entities.request);
  xrce_put_be16(&bytes[OBJECT_AT], object);
  (void)xrce_stream_best_effort_commit(&client->best_effort, &client->session, size);
}

/* Returns the kind of a place's object number `level`, and its id. */
static uint8_t object_of(uint16_t place, uint8_t level, uint16_t * object)
{
  uint8_t kind = XRCE_KIND_PARTICIPANT;

  if (place >= MICROROS_NODES_MAX) {
    kind = writer_kinds[level];
    place = (uint16_t)(place - MICROROS_NODES_MAX);
  }
  *object = xrce_object_id(place, kind);
  return kind;
}

void xrce_entities_send_create(xrce_client_t * client, uint16_t place, uint8_t level)
{
  enum { CREATE_FLAGS = XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_REUSE | XRCE_FLAG_REPLACE };
  uint8_t * bytes = xrce_stream_best_effort_reserve(&client->best_effort);
  uint16_t object;
  uint8_t * end;
  const uint8_t kind = object_of(place, level, &object);

  memset(&bytes[KIND_AT], 0, BLOB_AT - KIND_AT);
  bytes[KIND_AT] = kind;
  bytes[KIND_AT + 1] = FORMAT_BINARY;
  if (kind == XRCE_KIND_PARTICIPANT) {
    end = put_participant(&bytes[BLOB_AT], &client->participants[place]);
  } else {
    end = put_writer(&bytes[BLOB_AT], xrce_entities_writer(client, place), kind);
  }
  send_request(client, XRCE_CREATE, CREATE_FLAGS, object, (size_t)(end - bytes));
}

void xrce_entities_send_delete(xrce_client_t * client, uint16_t place, uint8_t level)
{
  uint16_t object;

  (void)object_of(place, level, &object);
  send_request(client, XRCE_DELETE, XRCE_FLAG_LITTLE_ENDIAN, object, DELETE_SIZE);
}
