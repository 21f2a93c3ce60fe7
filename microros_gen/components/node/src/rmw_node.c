/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_node.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"
#include "microros/xrce_place.h"

#include <stddef.h>

/*
 * Returns the kind of object that the place waits for: the next one, or the last one if it is being
 * deleted. */
static const char * place_kind(const xrce_client_t * client, uint16_t place)
{
  static const char * const of_writer[] = {"topic", "publisher", "datawriter", "datawriter"};
  static const char * const of_reader[] = {"topic", "subscriber", "datareader", "datareader"};
  const uint8_t level = client->states[place].level;

  if (xrce_place_is_participant(place)) {
    return "node";
  }
  if (xrce_place_is_service(place)) {
    return place < XRCE_REQUESTERS_AT ? "replier" : "requester";
  }
  return xrce_place_is_reader(place) ? of_reader[level] : of_writer[level];
}

rmw_ret_t rmw_place_open(xrce_client_t * client, uint16_t place, const char * name)
{
  uint8_t outcome;

  if (xrce_place_restore(client, place)) {
    return RMW_RET_OK;
  }
  xrce_entities_add(client, place);
  outcome = xrce_entities_await(client, place, client->create_timeout_ms);
  if (outcome == XRCE_DONE) {
    return RMW_RET_OK;
  }
  microros_error_set(
    outcome == XRCE_SILENT ? microros_error_entity_silent : microros_error_entity_refused, name,
    place_kind(client, place), outcome, client->create_timeout_ms);
  xrce_entities_remove(client, place);
  return outcome == XRCE_SILENT ? RMW_RET_TIMEOUT : RMW_RET_ERROR;
}

void rmw_place_close(xrce_client_t * client, uint16_t place)
{
  xrce_entities_remove(client, place);
  (void)xrce_entities_await(client, place, client->close_timeout_ms);
}

bool rmw_node_is_open(const rmw_node_t * node)
{
  return node != NULL && node->data != NULL && node->context->impl != NULL &&
         node->context->impl->states[rmw_node_index(node)].wanted;
}

uint16_t rmw_node_index(const rmw_node_t * node)
{
  const xrce_participant_t * participant = node->data;

  return (uint16_t)(participant - node->context->impl->participants);
}

static rmw_ret_t node_open(
  rmw_context_t * context, const char * name, const char * namespace_, rmw_node_t ** node)
{
  static rmw_node_t nodes[MICROROS_NODES_MAX]; /* indexed by place */
  xrce_client_t * client = context->impl;
  const uint16_t index = rmw_node_take(client, name, namespace_);
  xrce_participant_t * participant;
  rmw_ret_t result;

  if (index == RMW_NO_PLACE) {
    return RMW_RET_ERROR;
  }
  participant = &client->participants[index];
  if (context->options.domain_id != RMW_DEFAULT_DOMAIN_ID) {
    participant->domain_id = (uint16_t)context->options.domain_id;
  }
  result = rmw_place_open(client, index, name);
  if (result != RMW_RET_OK) {
    return result;
  }
  nodes[index].implementation_identifier = rmw_implementation_identifier;
  nodes[index].data = participant;
  nodes[index].name = participant->name;
  nodes[index].namespace_ = participant->namespace_;
  nodes[index].context = context;
  *node = &nodes[index];
  return RMW_RET_OK;
}

rmw_ret_t rmw_node_open(
  rmw_context_t * context, const char * name, const char * namespace_, rmw_node_t ** node)
{
  rmw_ret_t result;

  microros_lock();
  result = node_open(context, name, namespace_, node);
  microros_unlock();
  return result;
}

void rmw_node_close(rmw_node_t * node)
{
  microros_lock();
  rmw_place_close(node->context->impl, rmw_node_index(node));
  microros_unlock();
}
