/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_lifecycle_events.h"

#include "microros/rcl_lifecycle_states.h"
#include "microros/rmw_lifecycle.h"
#include "microros/rmw_node.h"
#include "microros_config.h"
#include "rcl/error_handling.h"

#include <stddef.h>

enum { EVENTS_MAX = 8 };

typedef struct lifecycle_events_t {
  uint8_t waiting[EVENTS_MAX]; /* positions in rcl_lifecycle_transitions */
  uint8_t count;
} lifecycle_events_t;

static lifecycle_events_t lifecycle_events[MICROROS_NODES_MAX];

static lifecycle_events_t * events_of(const rcl_node_t * node)
{
  return &lifecycle_events[rmw_node_index(node->impl)];
}

/* Publishes the oldest one and removes it; without room the stream counts it. */
static void events_publish(rcl_lifecycle_com_interface_t * offers, lifecycle_events_t * events)
{
  const rcl_lifecycle_transition_t * transition = &rcl_lifecycle_transitions[events->waiting[0]];

  offers->msg.start_state = rcl_lifecycle_message_of(transition->start);
  offers->msg.goal_state = rcl_lifecycle_message_of(transition->goal);
  --events->count;
  for (size_t i = 0; i < events->count; ++i) {
    events->waiting[i] = events->waiting[i + 1u];
  }
  if (rcl_publish(&offers->pub_transition_event, &offers->msg, NULL) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

void rcl_lifecycle_events_send(rcl_lifecycle_com_interface_t * offers)
{
  lifecycle_events_t * events = events_of(offers->node_handle);

  while (events->count != 0u && rmw_lifecycle_has_room(offers->pub_transition_event.impl)) {
    events_publish(offers, events);
  }
}

void rcl_lifecycle_events_add(
  rcl_lifecycle_com_interface_t * offers, const rcl_lifecycle_transition_t * transition)
{
  lifecycle_events_t * events = events_of(offers->node_handle);

  if (events->count == (uint8_t)EVENTS_MAX) {
    events_publish(offers, events);
  }
  events->waiting[events->count] = (uint8_t)(transition - rcl_lifecycle_transitions);
  ++events->count;
  rcl_lifecycle_events_send(offers);
}

void rcl_lifecycle_events_clear(const rcl_node_t * node)
{
  events_of(node)->count = 0;
}
