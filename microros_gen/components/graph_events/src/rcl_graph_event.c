/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_graph_event.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_graph_events.h"
#include "microros/xrce_local.h"
#include "microros/xrce_turn.h"

#include <stddef.h>
#include <string.h>

/* Outside of the client, as deadlines are: a saved session restores no pointers of the application. */
static rcl_graph_event_t graph_events[RCL_GRAPH_EVENTS];

rcl_graph_event_t * rcl_graph_event_at(uint16_t index)
{
  return &graph_events[index];
}

bool rcl_graph_event_is_open(const rcl_graph_event_t * event)
{
  const xrce_endpoint_t * const endpoint = event->endpoint;

  return event->base.observed && endpoint->client != NULL &&
         endpoint->client->states[MICROROS_NODES_MAX + endpoint->index].wanted;
}

static rcl_graph_event_t * event_take_place(const xrce_endpoint_t * endpoint, bool is_incompatible)
{
  rcl_graph_event_t * const event =
    rcl_graph_event_at((uint16_t)(2u * endpoint->index + (is_incompatible ? 1u : 0u)));

  if (event->base.observed) {
    return NULL;
  }
  (void)memset(event, 0, sizeof(*event));
  event->base.observed = true;
  event->endpoint = endpoint;
  event->policy = (uint32_t)RMW_QOS_POLICY_INVALID;
  event->is_incompatible = is_incompatible;
  event->is_due = true;
  return event;
}

rcl_ret_t rcl_graph_event_open(rcl_event_t * event, const xrce_endpoint_t * endpoint, bool is_incompatible)
{
  rcl_graph_event_t * place;

  if (event->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_event, "it is initialized already");
  }
  if (xrce_place_is_local((uint16_t)(MICROROS_NODES_MAX + endpoint->index))) {
    return microros_error_named(
      RCL_RET_UNSUPPORTED, microros_error_event, "its entity is local: ROS does not know it");
  }
  microros_lock();
  place = event_take_place(endpoint, is_incompatible);
  if (place != NULL) {
    xrce_turn_stored(endpoint->client); /* whoever receives asks for it */
  }
  microros_unlock();
  if (place == NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_event, "its entity has one already");
  }
  event->impl = &place->base;
  return RCL_RET_OK;
}

static rcl_graph_event_t * event_of(const xrce_deadline_t * base)
{
  for (uint16_t i = 0; i < (uint16_t)RCL_GRAPH_EVENTS; ++i) {
    if (&graph_events[i].base == base) {
      return &graph_events[i];
    }
  }
  return NULL;
}

static void event_write_incompatible(
  const rcl_graph_event_t * event, rmw_qos_incompatible_event_status_t * status)
{
  const uint32_t total = event->total & (uint32_t)INT32_MAX; /* the type has no more */
  const uint32_t change = (event->total - event->total_taken) & (uint32_t)INT32_MAX;

  status->total_count = (int32_t)total;
  status->total_count_change = (int32_t)change;
  status->last_policy_kind = (rmw_qos_policy_kind_t)event->policy;
}

static void event_write_matched(const rcl_graph_event_t * event, rmw_matched_status_t * status)
{
  const bool has_grown = event->current >= event->current_taken;
  const uint32_t change =
    has_grown ? event->current - event->current_taken : event->current_taken - event->current;
  const uint32_t new_total = event->total - event->total_taken;

  status->total_count = (size_t)event->total;
  status->total_count_change = (size_t)new_total;
  status->current_count = (size_t)event->current;
  status->current_count_change = has_grown ? (int32_t)change : -(int32_t)change;
}

bool rcl_graph_event_take(const xrce_deadline_t * event, void * event_info)
{
  rcl_graph_event_t * const found = event_of(event);

  if (found == NULL) {
    return false;
  }
  microros_lock();
  if (found->is_incompatible) {
    event_write_incompatible(found, event_info);
  } else {
    event_write_matched(found, event_info);
  }
  found->total_taken = found->total;
  found->current_taken = found->current;
  found->base.taken = found->base.total;
  microros_unlock();
  return true;
}

static void event_change(rcl_graph_event_t * event, uint32_t changes)
{
  event->base.total += changes;
  if (event->base.callback != NULL) {
    event->base.callback(event->base.user_data, (size_t)changes);
  }
}

void rcl_graph_event_answer(
  rcl_graph_event_t * event, const microros_graph_msgs__srv__EndpointStatus_Response * response)
{
  const uint32_t current = event->is_incompatible ? response->incompatible : response->matched;
  const uint32_t added = event->is_incompatible ? response->incompatible_new : response->matched_new;
  const bool has_left = !event->is_incompatible && current != event->current;

  event->instance = response->instance;
  event->newest = response->newest;
  event->current = current;
  event->total += added;
  if (added != 0u) {
    event->policy = response->policy;
    event_change(event, added);
  } else if (has_left) {
    event_change(event, 1u);
  } else {
    /* nothing has changed */
  }
}
