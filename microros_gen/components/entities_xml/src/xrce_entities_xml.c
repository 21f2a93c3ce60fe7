/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Objects in the XML of DDS profiles (OMG DDS-XRCE 1.0, 7.7.3). Names of ROS 2 and of DDS types contain no
 * character that XML escapes.
 */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_describe_service.h"
#include "microros/xrce_topic_prefix.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

/* Copies texts up to a NULL entry. */
static uint8_t * xml_put(uint8_t * at, const MICROROS_ANYWHERE char * const * texts)
{
  while (*texts != NULL) {
    at = xrce_describe_text(at, *texts++);
  }
  return at;
}

static uint8_t * xml_put_participant(uint8_t * at, const xrce_participant_t * participant)
{
  const bool is_root = participant->namespace_[1] == '\0';
  const MICROROS_ANYWHERE char * const texts[] = {
    MICROROS_FLASH_TEXT("<dds><participant><rtps><name>"),
    is_root ? "" : participant->namespace_,
    is_root ? "" : "/",
    participant->name,
    MICROROS_FLASH_TEXT("</name></rtps></participant></dds>"),
    NULL};

  return xml_put(at, texts);
}

/* Writes name and type of an endpoint's topic in their elements. */
static uint8_t * xml_put_topic(
  uint8_t * at, const xrce_endpoint_t * endpoint, const MICROROS_FLASH char * before,
  const MICROROS_FLASH char * after)
{
  const MICROROS_ANYWHERE char * const texts[] = {
    before,
    xrce_topic_prefix_xml(endpoint),
    endpoint->name,
    MICROROS_FLASH_TEXT("</name><dataType>"),
    endpoint->type->dds_type_name,
    MICROROS_FLASH_TEXT("</dataType>"),
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
  at = xml_put_number(xrce_describe_text(at, MICROROS_FLASH_TEXT("<depth>")), depth);
  return xrce_describe_text(at, MICROROS_FLASH_TEXT("</depth>"));
}

static uint8_t * xml_put_data(uint8_t * at, const xrce_endpoint_t * endpoint, bool reads)
{
  const MICROROS_ANYWHERE char * const texts[] = {
    MICROROS_FLASH_TEXT("</historyQos></topic><qos><durability><kind>"),
    (endpoint->qos & XRCE_QOS_TRANSIENT_LOCAL) != 0u ? MICROROS_FLASH_TEXT("TRANSIENT_LOCAL")
                                                     : MICROROS_FLASH_TEXT("VOLATILE"),
    MICROROS_FLASH_TEXT("</kind></durability><reliability><kind>"),
    (endpoint->qos & XRCE_QOS_RELIABLE) != 0u ? MICROROS_FLASH_TEXT("RELIABLE")
                                              : MICROROS_FLASH_TEXT("BEST_EFFORT"),
    reads ? MICROROS_FLASH_TEXT("</kind></reliability></qos></data_reader></dds>")
          : MICROROS_FLASH_TEXT("</kind></reliability></qos></data_writer></dds>"),
    NULL};

  at = xml_put_topic(
    at, endpoint,
    reads ? MICROROS_FLASH_TEXT("<dds><data_reader><topic><kind>NO_KEY</kind>")
          : MICROROS_FLASH_TEXT("<dds><data_writer><topic><kind>NO_KEY</kind>"),
    MICROROS_FLASH_TEXT("<historyQos><kind>KEEP_"));
  at = xrce_describe_text(
    at, (endpoint->qos & XRCE_QOS_KEEP_LAST) != 0u ? MICROROS_FLASH_TEXT("LAST</kind>")
                                                   : MICROROS_FLASH_TEXT("ALL</kind>"));
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
    end = xml_put_topic(
      blob, xrce_entities_endpoint(client, place), MICROROS_FLASH_TEXT("<dds><topic>"),
      MICROROS_FLASH_TEXT("</topic></dds>"));
  } else if (kind == XRCE_KIND_DATAWRITER) {
    end = xml_put_data(blob, xrce_entities_endpoint(client, place), false);
  } else if (xrce_place_is_reader(place) && kind == XRCE_KIND_DATAREADER) {
    end = xml_put_data(blob, xrce_entities_endpoint(client, place), true);
  }
  *end++ = 0;
  return end;
}
