/* SPDX-License-Identifier: Apache-2.0 */
/* Repliers and requesters in binary (OMG DDS-XRCE 1.0, annex A), with the least code: for few services. */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_describe_service.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* Before the characters of a string: their number, with the NUL. */
enum { SERVICE_LENGTH = 4, SERVICE_NUL = 1 };

/* Padding to a multiple of four from the start of the blob. */
static uint8_t * service_align(const uint8_t * blob, uint8_t * at)
{
  while (xrce_size_between(blob, at) % 4u != 0u) { /* at most 3 rounds */
    *at++ = 0;
  }
  return at;
}

/* A part of the blob, to be repeated. */
typedef struct service_part_t {
  const uint8_t * bytes;
  size_t size;
} service_part_t;

/* An aligned string: a text, what is repeated, another text. */
static uint8_t * service_put_string(
  const uint8_t * blob, uint8_t * at, const MICROROS_ANYWHERE char * first, const service_part_t * repeated,
  const char * last)
{
  uint8_t * const begin = service_align(blob, at);
  uint8_t * end = xrce_describe_text(&begin[SERVICE_LENGTH], first);

  if (repeated->size != 0u) {
    /* at most MICROROS_CREATION_SIZE or MICROROS_MTU bytes */
    (void)memcpy(end, repeated->bytes, repeated->size);
  }
  end = xrce_describe_text(&end[repeated->size], last);
  *end++ = 0;
  xrce_put_le32(begin, xrce_size_between(&begin[SERVICE_LENGTH], end));
  return end;
}

/*
 * Service name, message types; then the topics of requests and replies, both present. Name and type are repeated from
 * their first place, where their sizes are known. */
uint8_t * xrce_describe_service(
  const xrce_client_t * client, uint16_t place, uint8_t * blob, uint8_t * format)
{
  service_part_t name;
  service_part_t type = {blob, 0};
  uint8_t * end =
    service_put_string(blob, blob, client->endpoints[place - MICROROS_NODES_MAX].name, &type, "");

  *format = XRCE_FORMAT_BINARY;
  name.bytes = &blob[SERVICE_LENGTH];
  name.size = (size_t)xrce_size_between(name.bytes, end) - (size_t)SERVICE_NUL;
  end = service_align(blob, end);
  type.bytes = &end[SERVICE_LENGTH];
  end = service_put_string(
    blob, end, client->services[place - XRCE_REPLIERS_AT].type->dds_type_name, &type, "Request_");
  type.size = (size_t)xrce_size_between(type.bytes, end) - sizeof("Request_");
  end = service_put_string(blob, end, "", &type, "Response_");
  *end++ = 1;
  end = service_put_string(blob, end, "rq", &name, "Request");
  *end++ = 1;
  return service_put_string(blob, end, "rr", &name, "Reply");
}
