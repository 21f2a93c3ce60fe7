/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_peer_serving.h"

#include "microros/xrce_client.h"
#include "microros/xrce_peer_services.h"
#include "microros/xrce_read_grant.h"
#include "microros/xrce_wire.h"

#include <string.h>

static uint8_t serving_kept[MICROROS_PEERS]; /* slots for the replies to requests whose callbacks run */
static uint16_t
  serving_sessions[MICROROS_PEERS]; /* of the other board: a key comes again after some restarts */

void xrce_peer_serving_begin(uint8_t index)
{
  ++serving_sessions[index];
}

uint32_t xrce_peer_serving_unacknowledged(const xrce_client_t * client, uint8_t index)
{
  return client->peers[index].count;
}

bool xrce_peer_serving_keeps_all(const xrce_client_t * client, uint8_t index)
{
  return (uint32_t)client->peers[index].count + serving_kept[index] >= MICROROS_PEER_SLOTS;
}

void xrce_peer_serving_keep(uint8_t index)
{
  ++serving_kept[index];
}

void xrce_peer_serving_free(uint8_t index)
{
  if (serving_kept[index] != 0u) { /* a callback may have changed the identity */
    --serving_kept[index];
  }
}

uint8_t xrce_peer_serving_link(const uint8_t * guid)
{
  bool is_peer = guid[XRCE_PEER_LINK_AT] < MICROROS_PEERS && guid[XRCE_PEER_REST_AT] == 0u;

  for (size_t i = 0; i < (size_t)XRCE_PEER_MARK_SIZE; ++i) {
    is_peer = is_peer && guid[i] == (uint8_t)XRCE_PEER_MARK;
  }
  return is_peer ? guid[XRCE_PEER_LINK_AT] : (uint8_t)MICROROS_PEERS;
}

bool xrce_peer_serving_is_current(const xrce_client_t * client, uint8_t index, const uint8_t * guid)
{
  return xrce_get_be16(&guid[XRCE_PEER_SESSION_AT]) == serving_sessions[index] &&
         xrce_peer_services_is_key(guid, client->peers[index].other_key);
}

uint16_t xrce_peer_serving_object(uint8_t index, uint16_t service)
{
  for (uint16_t i = 0; i < (uint16_t)MICROROS_PEER_REPLIERS; ++i) {
    if (xrce_peer_repliers[i].link == index && xrce_peer_repliers[i].endpoint == service) {
      return xrce_object_id(xrce_peer_repliers[i].service, XRCE_KIND_REPLIER);
    }
  }
  return XRCE_PEER_NO_OBJECT;
}

uint16_t xrce_read_grant(uint16_t index, uint16_t room)
{
  uint16_t kept = 0;

  for (uint16_t i = 0; i < (uint16_t)MICROROS_PEER_REPLIERS; ++i) {
    if (index == (uint16_t)(XRCE_REPLIERS_AT - XRCE_READERS_AT + xrce_peer_repliers[i].endpoint)) {
      kept = (uint16_t)(kept + xrce_peer_repliers[i].requests);
    }
  }
  return room > kept ? (uint16_t)(room - kept) : 0u;
}

/* Puts the identity of a request in front of its body. */
static void serving_identify(const xrce_client_t * client, uint8_t index, const xrce_peer_data_t * data)
{
  uint8_t * identity = &data->input[data->at];
  const uint32_t key = client->peers[index].other_key;
  const bool is_little = (data->flags & XRCE_FLAG_LITTLE_ENDIAN) != 0u;

  (void)memset(identity, 0, XRCE_IDENTITY_SIZE);
  (void)memset(identity, XRCE_PEER_MARK, XRCE_PEER_MARK_SIZE);
  identity[XRCE_PEER_LINK_AT] = index;
  xrce_put_be16(&identity[XRCE_PEER_SESSION_AT], serving_sessions[index]);
  xrce_put_be16(&identity[XRCE_PEER_KEY_AT], (uint16_t)(key >> 16));
  xrce_put_be16(&identity[XRCE_PEER_KEY_AT + 2], (uint16_t)(key & UINT16_MAX));
  if (is_little) {
    xrce_put_le16(&identity[XRCE_PEER_LOW_AT], data->request);
  } else {
    xrce_put_be16(&identity[XRCE_PEER_LOW_AT + 2], data->request);
  }
}

bool xrce_peer_serving_take(xrce_client_t * client, uint8_t index, uint8_t * input, size_t at, uint32_t now)
{
  xrce_peer_data_t data;

  if (!xrce_peer_services_read(&data, input, at)) {
    return false;
  }
  for (uint16_t i = 0; i < (uint16_t)MICROROS_PEER_REPLIERS; ++i) {
    const xrce_peer_service_t * route = &xrce_peer_repliers[i];

    if (route->link == index && xrce_object_id(route->service, XRCE_KIND_REQUESTER) == data.object) {
      data.at -= (size_t)XRCE_IDENTITY_SIZE;
      data.size += (size_t)XRCE_IDENTITY_SIZE;
      serving_identify(client, index, &data);
      xrce_peer_services_keep(
        client, (uint16_t)(XRCE_REPLIERS_AT - XRCE_READERS_AT + route->endpoint), &data, now);
      return true;
    }
  }
  return false;
}
