/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Repliers and requesters in XML, as the public agent reads them; with the depth of ROS 2's services,
 * since the agent's default is 1. */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"

#include <stddef.h>

uint8_t * xrce_describe_service(
  const xrce_client_t * client, uint16_t place, uint8_t * blob, uint8_t * format)
{
  static const MICROROS_FLASH char depth[] = "<topic><historyQos><depth>10</depth></historyQos></topic>";
  const char * name = client->endpoints[place - MICROROS_NODES_MAX].name;
  const MICROROS_FLASH char * type = client->services[place - XRCE_REPLIERS_AT].type->dds_type_name;
  const MICROROS_FLASH char * kind =
    place < XRCE_REQUESTERS_AT ? MICROROS_FLASH_TEXT("replier") : MICROROS_FLASH_TEXT("requester");
  const MICROROS_ANYWHERE char * const texts[] = {
    MICROROS_FLASH_TEXT("<dds><"),
    kind,
    MICROROS_FLASH_TEXT(" profile_name=\""),
    name,
    MICROROS_FLASH_TEXT("\" service_name=\""),
    name,
    MICROROS_FLASH_TEXT("\" request_type=\""),
    type,
    MICROROS_FLASH_TEXT("Request_\" reply_type=\""),
    type,
    MICROROS_FLASH_TEXT("Response_\"><request_topic_name>rq"),
    name,
    MICROROS_FLASH_TEXT("Request</request_topic_name><reply_topic_name>rr"),
    name,
    MICROROS_FLASH_TEXT("Reply</reply_topic_name><publisher>"),
    depth,
    MICROROS_FLASH_TEXT("</publisher><subscriber>"),
    depth,
    MICROROS_FLASH_TEXT("</subscriber></"),
    kind,
    MICROROS_FLASH_TEXT("></dds>"),
    NULL};
  uint8_t * end = blob;

  *format = XRCE_FORMAT_XML;
  for (const MICROROS_ANYWHERE char * const * text = texts; *text != NULL; ++text) {
    end = xrce_describe_text(end, *text);
  }
  *end++ = 0;
  return end;
}
