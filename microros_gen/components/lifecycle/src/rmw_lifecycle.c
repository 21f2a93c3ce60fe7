/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_lifecycle.h"

#include "microros/lock.h"
#include "microros/rmw_node.h"
#include "microros/xrce_client.h"
#include "microros/xrce_parameters.h"
#include "microros/xrce_write_room.h"

#include <stddef.h>
#include <string.h>

/* In SampleIdentity (OMG DDS-XRCE 1.0, annex A): the writer's GUID, then the two halves of the sequence number. */
enum { NUMBER_HIGH_AT = RMW_GID_STORAGE_SIZE, NUMBER_LOW_AT = NUMBER_HIGH_AT + 4 };

uint8_t rmw_lifecycle_state(const rmw_node_t * node)
{
  const xrce_client_t * client = node->context->impl;

  return client->lifecycle[rmw_node_index(node)];
}

void rmw_lifecycle_set_state(const rmw_node_t * node, uint8_t state)
{
  xrce_client_t * client = node->context->impl;

  microros_lock();
  client->lifecycle[rmw_node_index(node)] = state;
  microros_unlock();
}

void rmw_lifecycle_use(const rmw_node_t * node, xrce_parts_body_t body)
{
  xrce_client_t * client = node->context->impl;

  microros_lock();
  client->parts.body = body;
  microros_unlock();
}

bool rmw_lifecycle_is_replying(const rmw_node_t * node)
{
  const xrce_client_t * client = node->context->impl;

  return client->parts.busy;
}

bool rmw_lifecycle_has_room(const rmw_publisher_t * publisher)
{
  return publisher != NULL && xrce_write_has_room(publisher->data);
}

void rmw_lifecycle_answer_large(const rmw_service_t * service, bool answers)
{
  microros_lock();
  xrce_parameters_keep_beginning(service->data, answers ? (uint8_t)XRCE_PARAMETERS_BEGINNING : 0u);
  microros_unlock();
}

static void lifecycle_put_4(uint8_t * at, uint32_t number)
{
  xrce_put_le16(&at[0], (uint16_t)(number & UINT16_MAX));
  xrce_put_le16(&at[2], (uint16_t)(number >> 16));
}

void rmw_lifecycle_reply(const rmw_service_t * service, const rmw_request_id_t * request)
{
  const xrce_endpoint_t * endpoint = service->data;
  const uint64_t sequence = (uint64_t)request->sequence_number;
  uint8_t identity[XRCE_IDENTITY_SIZE];

  (void)memcpy(identity, request->writer_guid, RMW_GID_STORAGE_SIZE);
  lifecycle_put_4(&identity[NUMBER_HIGH_AT], (uint32_t)(sequence >> 32));
  lifecycle_put_4(&identity[NUMBER_LOW_AT], (uint32_t)(sequence & UINT32_MAX));
  microros_lock();
  xrce_parts_begin(endpoint->client, endpoint->index, identity);
  microros_unlock();
}
