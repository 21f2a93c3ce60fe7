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
  static const char depth[] = "<topic><historyQos><depth>10</depth></historyQos></topic>";
  const char * name = client->endpoints[place - MICROROS_NODES_MAX].name;
  const char * type = client->services[place - XRCE_REPLIERS_AT].type->dds_type_name;
  const char * kind = place < XRCE_REQUESTERS_AT ? "replier" : "requester";
  const char * const texts[] = {
    "<dds><",
    kind,
    " profile_name=\"",
    name,
    "\" service_name=\"",
    name,
    "\" request_type=\"",
    type,
    "Request_\" reply_type=\"",
    type,
    "Response_\"><request_topic_name>rq",
    name,
    "Request</request_topic_name><reply_topic_name>rr",
    name,
    "Reply</reply_topic_name><publisher>",
    depth,
    "</publisher><subscriber>",
    depth,
    "</subscriber></",
    kind,
    "></dds>",
    NULL};
  uint8_t * end = blob;

  *format = XRCE_FORMAT_XML;
  for (const char * const * text = texts; *text != NULL; ++text) {
    end = xrce_describe_text(end, *text);
  }
  *end++ = 0;
  return end;
}
