/* SPDX-License-Identifier: Apache-2.0 */
/* Objects in binary (OMG DDS-XRCE 1.0, 7.7.3 and annex A). */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_describe_service.h"
#include "microros/xrce_topic_prefix.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* A string of up to three parts: total length, the parts, one NUL. Below 64 KiB, since a message is. */
static uint8_t * binary_put_string(
  uint8_t * at, const MICROROS_ANYWHERE char * first, const char * second, const MICROROS_ANYWHERE char * third)
{
  uint8_t * end = xrce_describe_text(xrce_describe_text(xrce_describe_text(&at[4], first), second), third);

  *end++ = 0;
  xrce_put_le32(at, xrce_size_between(&at[4], end));
  return end;
}

/* The name is that of a QoS profile; no domain reference. */
static uint8_t * binary_put_participant(uint8_t * blob, const xrce_participant_t * participant)
{
  const bool is_root = participant->namespace_[1] == '\0';

  (void)memset(blob, 0, 4);
  blob[1] = 1;
  return binary_put_string(
    &blob[4], is_root ? "" : participant->namespace_, is_root ? "" : "/", participant->name);
}

/* No type reference, but a type name, padded to four from the start of the blob. */
static uint8_t * binary_put_topic(uint8_t * blob, const xrce_endpoint_t * endpoint)
{
  uint8_t * end = binary_put_string(blob, xrce_topic_prefix(endpoint), "", endpoint->name);

  *end++ = 0;
  *end++ = 1;
  while (xrce_size_between(blob, end) % 4u != 0u) { /* at most 3 rounds */
    *end++ = 0;
  }
  return binary_put_string(end, "", "", endpoint->type->dds_type_name);
}

/* QoS: flags, depth if set; neither deadline, lifespan, user data nor ownership strength. */
static uint8_t * binary_put_data_writer(uint8_t * blob, const xrce_endpoint_t * endpoint)
{
  (void)memset(blob, 0, 14);
  xrce_put_be16(&blob[0], xrce_object_id(endpoint->index, XRCE_KIND_TOPIC));
  blob[2] = 1;
  blob[4] = endpoint->qos;
  if (endpoint->depth == 0u) {
    return &blob[11];
  }
  blob[6] = 1;
  xrce_put_le16(&blob[8], endpoint->depth);
  return &blob[14];
}

/* Like a data writer's, with neither time-based nor content filter in place of ownership strength. */
static uint8_t * binary_put_data_reader(uint8_t * blob, const xrce_endpoint_t * endpoint)
{
  uint8_t * end = binary_put_data_writer(blob, endpoint);

  *end++ = 0;
  return end;
}

uint8_t * xrce_describe(
  const xrce_client_t * client, uint16_t place, uint8_t kind, uint8_t * blob, uint8_t * format)
{
  if (xrce_place_is_service(place)) {
    return xrce_describe_service(client, place, blob, format);
  }
  *format = XRCE_FORMAT_BINARY;
  if (xrce_place_is_reader(place) && kind == XRCE_KIND_DATAREADER) {
    return binary_put_data_reader(blob, xrce_entities_endpoint(client, place));
  }
  switch (kind) {
    case XRCE_KIND_PARTICIPANT:
      return binary_put_participant(blob, &client->participants[place]);
    case XRCE_KIND_TOPIC:
      return binary_put_topic(blob, xrce_entities_endpoint(client, place));
    case XRCE_KIND_DATAWRITER:
      return binary_put_data_writer(blob, xrce_entities_endpoint(client, place));
    default: /* a publisher or subscriber: neither name nor QoS */
      xrce_put_le16(blob, 0);
      return &blob[2];
  }
}
