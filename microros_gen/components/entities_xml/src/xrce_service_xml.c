/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Repliers and requesters in XML, as the public agent reads them; with the depth of ROS 2's services,
 * since the agent's default is 1. A description has some 600 characters: each part is copied as a block of known size. */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_describe_service.h"
#include "microros/xrce_service_sizes.h"

/* Texts that differ between services, and one that a description has two times. */
enum { SERVICE_NAME, SERVICE_TYPE, SERVICE_KIND, SERVICE_DEPTH, SERVICE_TEXTS };

typedef struct service_part_t {
  const MICROROS_FLASH char * words;
  uint8_t size;
  uint8_t then; /* the text that follows */
} service_part_t;

typedef struct service_text_t {
  const MICROROS_ANYWHERE char * words;
  size_t size;
} service_text_t;

#define SERVICE_PART(words, then) \
  { \
    MICROROS_FLASH_NAME(words), (uint8_t)(sizeof(words) - 1u), (then) \
  }

static const MICROROS_FLASH service_part_t service_parts[] = {
  SERVICE_PART("<dds><", SERVICE_KIND),
  SERVICE_PART(" profile_name=\"", SERVICE_NAME),
  SERVICE_PART("\" service_name=\"", SERVICE_NAME),
  SERVICE_PART("\" request_type=\"", SERVICE_TYPE),
  SERVICE_PART("Request_\" reply_type=\"", SERVICE_TYPE),
  SERVICE_PART("Response_\"><request_topic_name>rq", SERVICE_NAME),
  SERVICE_PART("Request</request_topic_name><reply_topic_name>rr", SERVICE_NAME),
  SERVICE_PART("Reply</reply_topic_name><publisher>", SERVICE_DEPTH),
  SERVICE_PART("</publisher><subscriber>", SERVICE_DEPTH),
  SERVICE_PART("</subscriber></", SERVICE_KIND)};
static const MICROROS_FLASH char service_depth[] =
  "<topic><historyQos><depth>10</depth></historyQos></topic>";
static const MICROROS_FLASH char service_end[] = "></dds>";

uint8_t * xrce_describe_service(
  const xrce_client_t * client, uint16_t place, uint8_t * blob, uint8_t * format)
{
  const xrce_service_sizes_t sizes = xrce_service_sizes_of(client, place);
  const bool replies = place < XRCE_REQUESTERS_AT;
  const service_text_t texts[SERVICE_TEXTS] = {
    {client->endpoints[place - MICROROS_NODES_MAX].name, sizes.name},
    {client->services[place - XRCE_REPLIERS_AT].type->dds_type_name, sizes.type},
    {replies ? MICROROS_FLASH_TEXT("replier") : MICROROS_FLASH_TEXT("requester"),
     replies ? sizeof("replier") - 1u : sizeof("requester") - 1u},
    {service_depth, sizeof(service_depth) - 1u}};
  uint8_t * end = blob;

  *format = XRCE_FORMAT_XML;
  for (size_t i = 0; i < sizeof(service_parts) / sizeof(service_parts[0]); ++i) {
    const service_text_t * text = &texts[service_parts[i].then];

    end = xrce_describe_sized(end, service_parts[i].words, service_parts[i].size);
    end = xrce_describe_sized(end, text->words, text->size);
  }
  end = xrce_describe_sized(end, service_end, sizeof(service_end) - 1u);
  *end++ = 0;
  return end;
}
