/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Objects in the XML of DDS profiles (OMG DDS-XRCE 1.0, 7.7.3). Names of ROS 2 and of DDS types contain no
 * character that XML escapes.
 */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_topic_prefix.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

/* Copies texts up to a NULL entry. */
static uint8_t * xml_put(uint8_t * at, const char * const * texts)
{
  while (*texts != NULL) {
    at = xrce_describe_text(at, *texts++);
  }
  return at;
}

static uint8_t * xml_put_participant(uint8_t * at, const xrce_participant_t * participant)
{
  const bool is_root = participant->namespace_[1] == '\0';
  const char * const texts[] = {
    "<dds><participant><rtps><name>",
    is_root ? "" : participant->namespace_,
    is_root ? "" : "/",
    participant->name,
    "</name></rtps></participant></dds>",
    NULL};

  return xml_put(at, texts);
}

/* Writes name and type of an endpoint's topic in their elements. */
static uint8_t * xml_put_topic(
  uint8_t * at, const xrce_endpoint_t * endpoint, const char * before, const char * after)
{
  const char * const texts[] = {
    before,
    xrce_topic_prefix_xml(endpoint),
    endpoint->name,
    "</name><dataType>",
    endpoint->type->dds_type_name,
    "</dataType>",
    after,
    NULL};

  return xml_put(at, texts);
}

static uint8_t * xml_put_number(uint8_t * at, uint16_t number)
{
  uint16_t unit = 10000;

  while (unit > number) {
    unit = (uint16_t)(unit / 10u);
  }
  for (; unit != 0u; unit = (uint16_t)(unit / 10u)) {
    *at++ = (uint8_t)('0' + number / unit % 10u);
  }
  return at;
}

/* Depth 0 is the agent's default: no element. */
static uint8_t * xml_put_depth(uint8_t * at, uint16_t depth)
{
  if (depth == 0u) {
    return at;
  }
  at = xml_put_number(xrce_describe_text(at, "<depth>"), depth);
  return xrce_describe_text(at, "</depth>");
}

static uint8_t * xml_put_data(uint8_t * at, const xrce_endpoint_t * endpoint, bool reads)
{
  const char * const texts[] = {
    "</historyQos></topic><qos><durability><kind>",
    (endpoint->qos & XRCE_QOS_TRANSIENT_LOCAL) != 0u ? "TRANSIENT_LOCAL" : "VOLATILE",
    "</kind></durability><reliability><kind>",
    (endpoint->qos & XRCE_QOS_RELIABLE) != 0u ? "RELIABLE" : "BEST_EFFORT",
    reads ? "</kind></reliability></qos></data_reader></dds>"
          : "</kind></reliability></qos></data_writer></dds>",
    NULL};

  at = xml_put_topic(
    at, endpoint,
    reads ? "<dds><data_reader><topic><kind>NO_KEY</kind>" : "<dds><data_writer><topic><kind>NO_KEY</kind>",
    "<historyQos><kind>KEEP_");
  at = xrce_describe_text(at, (endpoint->qos & XRCE_QOS_KEEP_LAST) != 0u ? "LAST</kind>" : "ALL</kind>");
  return xml_put(xml_put_depth(at, endpoint->depth), texts);
}

/* The text of a publisher or subscriber is empty. */
uint8_t * xrce_describe(
  const xrce_client_t * client, uint16_t place, uint8_t kind, uint8_t * blob, uint8_t * format)
{
  uint8_t * end = blob;

  if (xrce_place_is_service(place)) {
    return xrce_describe_service(client, place, blob, format);
  }
  *format = XRCE_FORMAT_XML;
  if (kind == XRCE_KIND_PARTICIPANT) {
    end = xml_put_participant(blob, &client->participants[place]);
  } else if (kind == XRCE_KIND_TOPIC) {
    end = xml_put_topic(blob, xrce_entities_endpoint(client, place), "<dds><topic>", "</topic></dds>");
  } else if (kind == XRCE_KIND_DATAWRITER) {
    end = xml_put_data(blob, xrce_entities_endpoint(client, place), false);
  } else if (xrce_place_is_reader(place) && kind == XRCE_KIND_DATAREADER) {
    end = xml_put_data(blob, xrce_entities_endpoint(client, place), true);
  }
  *end++ = 0;
  return end;
}
