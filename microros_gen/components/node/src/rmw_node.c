/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_node.h"

#include "microros/error.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"

#include <stddef.h>

rmw_ret_t rmw_report_outcome(xrce_client_t * client, xrce_outcome_t outcome, bool is_node, const char * name)
{
  static const char * const objects[] = {"topic", "publisher", "datawriter"};
  const xrce_entities_t * entities = &client->entities;

  if (outcome == XRCE_DONE) {
    return RMW_RET_OK;
  }
  if (outcome == XRCE_REFUSED) {
    const char * kind = is_node ? "node" : objects[entities->refused_level];

    microros_error_set(MICROROS_ERROR_ENTITY_REFUSED, name, kind, entities->refused_status, 0);
    return RMW_RET_ERROR;
  }
  microros_error_set(
    MICROROS_ERROR_ENTITY_SILENT, name, is_node ? "node" : objects[1], 0, client->create_timeout_ms);
  return RMW_RET_TIMEOUT;
}

bool rmw_node_is_open(const rmw_node_t * node)
{
  const xrce_participant_t * participant;

  if (node == NULL || node->implementation_identifier != rmw_implementation_identifier) {
    return false;
  }
  participant = node->data;
  return participant->state.wanted;
}

uint16_t rmw_node_index(const rmw_node_t * node)
{
  const xrce_participant_t * participant = node->data;

  return (uint16_t)(participant - node->context->impl->participants);
}

rmw_ret_t rmw_node_open(rmw_context_t * context, const char * name, const char * namespace_, rmw_node_t ** node)
{
  static rmw_node_t nodes[MICROROS_NODES_MAX]; /* handed out by place */
  xrce_client_t * client = context->impl;
  const uint16_t index = rmw_node_take(client, name, namespace_);
  xrce_participant_t * participant;
  xrce_outcome_t outcome;

  if (index == RMW_NO_PLACE) {
    return RMW_RET_ERROR;
  }
  participant = &client->participants[index];
  if (context->options.domain_id != RMW_DEFAULT_DOMAIN_ID) {
    participant->domain_id = (uint16_t)context->options.domain_id;
  }
  xrce_entities_add(client, &participant->state);
  outcome = xrce_entities_await_participant(client, index, client->create_timeout_ms);
  if (outcome != XRCE_DONE) {
    xrce_entities_remove(client, &participant->state);
    return rmw_report_outcome(client, outcome, true, name);
  }
  nodes[index].implementation_identifier = rmw_implementation_identifier;
  nodes[index].data = participant;
  nodes[index].name = participant->name;
  nodes[index].namespace_ = participant->namespace_;
  nodes[index].context = context;
  *node = &nodes[index];
  return RMW_RET_OK;
}

void rmw_node_close(rmw_node_t * node)
{
  xrce_client_t * client = node->context->impl;
  const uint16_t index = rmw_node_index(node);

  node->implementation_identifier = NULL;
  xrce_entities_remove_participant(client, index);
  (void)xrce_entities_await_participant(client, index, client->close_timeout_ms); /* later calls do what is left */
}
