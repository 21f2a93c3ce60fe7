/* SPDX-License-Identifier: Apache-2.0 */
/* Repliers and requesters in binary (OMG DDS-XRCE 1.0, annex A). */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_wire.h"

/* Padding to a multiple of four from the start of the blob. */
static uint8_t * service_align(const uint8_t * blob, uint8_t * at)
{
  while (xrce_size_between(blob, at) % 4u != 0u) {
    *at++ = 0;
  }
  return at;
}

/* An aligned string of up to three parts. */
static uint8_t * service_put_string(
  const uint8_t * blob, uint8_t * at, const char * first, const char * second, const char * third)
{
  uint8_t * const begin = service_align(blob, at);
  uint8_t * end = xrce_describe_text(&begin[4], first);

  end = xrce_describe_text(xrce_describe_text(end, second), third);
  *end++ = 0;
  xrce_put_le16(&begin[0], xrce_size_between(&begin[4], end));
  xrce_put_le16(&begin[2], 0);
  return end;
}

/* Service name, message types; then the topics of requests and replies, both present. */
uint8_t * xrce_describe_service(
  const xrce_client_t * client, uint16_t place, uint8_t * blob, uint8_t * format)
{
  const char * name = client->endpoints[place - MICROROS_NODES_MAX].name;
  const char * type = client->services[place - XRCE_REPLIERS_AT].type->dds_type_name;
  uint8_t * end = service_put_string(blob, blob, name, "", "");

  *format = XRCE_FORMAT_BINARY;
  end = service_put_string(blob, end, type, "Request_", "");
  end = service_put_string(blob, end, type, "Response_", "");
  *end++ = 1;
  end = service_put_string(blob, end, "rq", name, "Request");
  *end++ = 1;
  return service_put_string(blob, end, "rr", name, "Reply");
}
