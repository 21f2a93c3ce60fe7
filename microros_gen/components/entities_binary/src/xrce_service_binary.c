/* SPDX-License-Identifier: Apache-2.0 */
/* Repliers and requesters in binary (OMG DDS-XRCE 1.0, annex A). */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_describe_service.h"
#include "microros/xrce_service_sizes.h"
#include "microros/xrce_wire.h"

#include <string.h>

/* Before the characters of a string: their number, with the NUL. */
enum { SERVICE_LENGTH = 4 };

/* After a name, or after the two letters in front of one. */
static const char request_type[] = "Request_";
static const char reply_type[] = "Response_";
static const char request_topic[] = "Request";
static const char reply_topic[] = "Reply";

/* Writes the length of the string between these two, its NUL included, in front of it. */
static void service_count(uint8_t * begin, const uint8_t * end)
{
  xrce_put_le32(&begin[-SERVICE_LENGTH], xrce_size_between(begin, end));
}

/*
 * Ends a string that another one follows: `present` is 1 if what follows is optional, which takes a byte, otherwise 0.
 * Then pads to a multiple of four from the start of the blob. Returns where the characters of the next string begin. */
static uint8_t * service_next(uint8_t * blob, uint8_t * begin, uint8_t * end, uint8_t present)
{
  const size_t at = ((size_t)xrce_size_between(blob, end) + present + 3u) & ~(size_t)3u;

  service_count(begin, end);
  xrce_put_le32(end, present); /* what is neither this nor padding is in the length that follows */
  return &blob[at + (size_t)SERVICE_LENGTH];
}

/*
 * Service name, message types; then the topics of requests and replies, both present. The endings are copied by their
 * constant sizes, which takes a few stores. */
uint8_t * xrce_describe_service(
  const xrce_client_t * client, uint16_t place, uint8_t * blob, uint8_t * format)
{
  const char * name = client->endpoints[place - MICROROS_NODES_MAX].name;
  const MICROROS_FLASH char * type = client->services[place - XRCE_REPLIERS_AT].type->dds_type_name;
  const xrce_service_sizes_t sizes = xrce_service_sizes_of(client, place);
  uint8_t * begin = &blob[SERVICE_LENGTH];
  uint8_t * end = xrce_describe_sized(begin, name, sizes.name);

  *format = XRCE_FORMAT_BINARY;
  *end++ = 0;
  begin = service_next(blob, begin, end, 0);
  end = xrce_describe_sized(begin, type, sizes.type);
  (void)memcpy(end, request_type, sizeof(request_type));
  begin = service_next(blob, begin, &end[sizeof(request_type)], 0);
  end = xrce_describe_sized(begin, type, sizes.type);
  (void)memcpy(end, reply_type, sizeof(reply_type));
  begin = service_next(blob, begin, &end[sizeof(reply_type)], 1);
  begin[0] = (uint8_t)'r';
  begin[1] = (uint8_t)'q';
  end = xrce_describe_sized(&begin[2], name, sizes.name);
  (void)memcpy(end, request_topic, sizeof(request_topic));
  begin = service_next(blob, begin, &end[sizeof(request_topic)], 1);
  begin[0] = (uint8_t)'r';
  begin[1] = (uint8_t)'r';
  end = xrce_describe_sized(&begin[2], name, sizes.name);
  (void)memcpy(end, reply_topic, sizeof(reply_topic));
  end = &end[sizeof(reply_topic)];
  service_count(begin, end);
  return end;
}
