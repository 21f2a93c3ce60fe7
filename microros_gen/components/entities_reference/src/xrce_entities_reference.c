/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Objects by the names under which the agent finds them in its references file. The names are those of
 * micro-ROS's rmw: "participant_profile" of a client with one node, "imu/data__t" of a topic,
 * "imu/data__dw" of its data writer and "imu/data__dr" of its data reader. With several nodes each has a
 * separate one: "arm/imu__p". A publisher or subscriber has no name; its text is empty.
 */
#include "microros/xrce_client.h"
#include "microros/xrce_creation.h"
#include "microros/xrce_describe_service.h"
#include "microros/xrce_wire.h"

static uint8_t * reference_put_participant(uint8_t * at, const xrce_participant_t * participant)
{
  if (MICROROS_NODES_MAX == 1u) {
    return xrce_describe_text(at, "participant_profile");
  }
  if (participant->namespace_[1] != '\0') {
    at = xrce_describe_text(at, &participant->namespace_[1]);
    *at++ = '/';
  }
  return xrce_describe_text(xrce_describe_text(at, participant->name), "__p");
}

uint8_t * xrce_describe(
  const xrce_client_t * client, uint16_t place, uint8_t kind, uint8_t * blob, uint8_t * format)
{
  uint8_t * end = blob;

  if (xrce_place_is_service(place)) {
    return xrce_describe_service(client, place, blob, format);
  }
  *format = XRCE_FORMAT_REFERENCE;
  if (kind == XRCE_KIND_PARTICIPANT) {
    end = reference_put_participant(blob, &client->participants[place]);
  } else if (kind == XRCE_KIND_PUBLISHER || (xrce_place_is_reader(place) && kind == XRCE_KIND_SUBSCRIBER)) {
    *format = XRCE_FORMAT_XML;
  } else if (xrce_place_is_reader(place)) {
    end = xrce_describe_text(blob, &xrce_entities_endpoint(client, place)->name[1]);
    end = xrce_describe_text(end, kind == XRCE_KIND_TOPIC ? "__t" : "__dr");
  } else {
    end = xrce_describe_text(blob, &xrce_entities_endpoint(client, place)->name[1]);
    end = xrce_describe_text(end, kind == XRCE_KIND_TOPIC ? "__t" : "__dw");
  }
  *end++ = 0;
  return end;
}
