/* SPDX-License-Identifier: Apache-2.0 */
/* One request at a time, each for one event: when it was opened, and when the graph has changed. Whichever task receives
 * makes them. */
#include "microros/rcl_graph_events.h"

#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rcl_client_open.h"
#include "microros/rcl_graph.h"
#include "microros/rcl_graph_events_hooks.h"
#include "microros/rcl_graph_server.h"
#include "microros/rmw_client.h"
#include "microros/rmw_node.h"
#include "microros/rmw_qos.h"
#include "microros/rmw_service.h"
#include "microros/xrce_client.h"
#include "microros/xrce_turn.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write_room.h"
#include "rcl/error_handling.h"
#include "rmw/qos_profiles.h"

#include <string.h>

static bool events_request(
  const rcl_graph_event_t * event, microros_graph_msgs__srv__EndpointStatus_Request * request)
{
  static char topic_full[MICROROS_GRAPH_NAME_SIZE];
  static char node_full[MICROROS_GRAPH_NAME_SIZE];
  const xrce_endpoint_t * const own = event->endpoint;
  const xrce_participant_t * const participant = &own->client->participants[own->participant];
  const rmw_name_t node = rmw_name_of_topic(participant->name, participant->name, participant->namespace_);
  const rmw_name_t topic = {{own->name, "", "", ""}};
  rmw_qos_profile_t qos;

  if (rmw_name_size(&topic) >= MICROROS_GRAPH_NAME_SIZE || rmw_name_size(&node) >= MICROROS_GRAPH_NAME_SIZE) {
    return false;
  }
  rmw_name_copy(&topic, topic_full);
  rmw_name_copy(&node, node_full);
  rmw_qos_actual(own, &qos);
  (void)memset(request, 0, sizeof(*request));
  rcl_graph_lend(&request->topic, topic_full);
  rcl_graph_lend(&request->node, node_full);
  request->subscription = own->index >= MICROROS_PUBLISHERS_MAX;
  request->reliability = (uint8_t)qos.reliability;
  request->durability = (uint8_t)qos.durability;
  request->deadline = (uint64_t)rmw_time_total_nsec(qos.deadline);
  request->newest = event->newest;
  return true;
}

/* Time until a request is sent once more: no server has answered, or it does not know the endpoint yet. After that many
 * requests without an answer any server may answer. */
enum { EVENTS_AGAIN_MS = 1000, EVENTS_SILENCES = 2 };

static const rmw_node_t * events_node; /* the owner of the client */
static rcl_client_t events_client;
static int64_t events_sequence_number;
static uint32_t events_server;  /* the instance that has answered last; 0: none has */
static uint8_t events_silences; /* requests without an answer */
static uint32_t events_graph;   /* the change of the graph that was asked about */
static uint32_t events_due_ms;  /* while `events_pause`: no request before */
static uint16_t events_current; /* the event of the request */
static bool events_pause;
static bool events_wait;   /* for a response, at most until `events_due_ms` */
static bool events_busy;   /* a task makes requests */
static bool events_missed; /* another one came meanwhile */

static bool events_begin(void)
{
  bool is_free;

  microros_lock();
  is_free = !events_busy;
  events_busy = true;
  events_missed = events_missed || !is_free;
  microros_unlock();
  return is_free;
}

/* Whichever task receives looks at the events again. */
static void events_notify(void)
{
  microros_lock();
  xrce_turn_stored(rmw_client_instance());
  microros_unlock();
}

static void events_end(void)
{
  microros_lock();
  events_busy = false;
  if (events_missed) {
    events_missed = false;
    xrce_turn_stored(
      rmw_client_instance()); /* it may have seen an event that this task had looked at before */
  }
  microros_unlock();
}

/* Whichever task waits reads it (rcl_graph_events_left). */
static void events_set_pause(bool pauses)
{
  microros_lock();
  events_pause = pauses;
  microros_unlock();
}

/* Another task makes a request, which does not take long. */
static void events_enter(void)
{
  while (!events_begin()) {
    microros_lock();
    microros_pause();
    microros_unlock();
  }
}

rcl_ret_t rcl_graph_events_open(const rcl_node_t * node)
{
  rcl_client_t client = rcl_get_zero_initialized_client();
  rcl_ret_t result;

  if (rmw_node_index(node->impl) != 0u) {
    return RCL_RET_OK;
  }
  result = rcl_client_open(
    &client, node, ROSIDL_GET_SRV_TYPE_SUPPORT(microros_graph_msgs, srv, EndpointStatus),
    "/microros_graph/endpoint_status", &rmw_qos_profile_services_default);
  events_enter();
  events_node = node->impl;
  events_wait = false;
  events_set_pause(false);
  events_client = client;
  events_end();
  events_notify(); /* of the events that have waited for it */
  return result;
}

void rcl_graph_events_close(rcl_node_t * node)
{
  events_enter();
  if (events_node == node->impl) {
    (void)rcl_client_fini(&events_client, node); /* cannot fail: the node is open */
    events_node = NULL;
  }
  events_end();
}

static void events_rest(uint32_t now)
{
  microros_lock();
  events_due_ms = now + (uint32_t)EVENTS_AGAIN_MS;
  events_pause = true;
  microros_unlock();
}

static void events_answer(
  rcl_graph_event_t * event, const microros_graph_msgs__srv__EndpointStatus_Response * response, uint32_t now)
{
  events_wait = false;
  events_pause = false;
  events_silences = 0;
  events_server = response->instance;
  if (response->status == (uint8_t)microros_graph_msgs__srv__EndpointStatus_Response__UNKNOWN_NODE) {
    events_rest(now); /* not discovered yet */
  } else if (event->is_requested) {
    event->is_due = false;
    event->graph = events_graph;
    if (
      response->status == (uint8_t)microros_graph_msgs__srv__EndpointStatus_Response__OK &&
      rcl_graph_event_is_open(event)) {
      rcl_graph_event_answer(event, response);
    }
  } else {
    /* asked for again */
  }
}

static void events_take(uint32_t now)
{
  microros_graph_msgs__srv__EndpointStatus_Response response;
  rmw_request_id_t header;

  if (rcl_take_response(&events_client, &header, &response) != RCL_RET_OK) {
    rcl_reset_error(); /* counted; it is asked for once more */
    return;
  }
  microros_lock();
  if (events_wait && header.sequence_number == events_sequence_number) {
    events_answer(rcl_graph_event_at(events_current), &response, now);
  }
  microros_unlock();
}

/* Returns the next event that is due; false: none is. */
static bool events_next(uint32_t graph)
{
  for (uint16_t i = 0; i < (uint16_t)RCL_GRAPH_EVENTS; ++i) {
    const rcl_graph_event_t * event;

    events_current = (uint16_t)((events_current + 1u) % (uint16_t)RCL_GRAPH_EVENTS);
    event = rcl_graph_event_at(events_current);
    if (rcl_graph_event_is_open(event) && (event->is_due || event->graph != graph)) {
      return true;
    }
  }
  return false;
}

/* Events stay with one server, whose counts those of another one would double. */
static void events_address(
  const rcl_graph_event_t * event, microros_graph_msgs__srv__EndpointStatus_Request * request)
{
  const bool has_other = event->instance != 0u && event->instance != events_server;

  request->instance = event->instance != 0u ? event->instance : events_server;
  request->any_server = has_other || events_silences == (uint8_t)EVENTS_SILENCES;
}

static void events_ask(uint32_t graph, uint32_t now)
{
  microros_graph_msgs__srv__EndpointStatus_Request request;
  bool is_due;
  bool fits = false;

  microros_lock();
  is_due = events_next(graph);
  if (is_due) {
    rcl_graph_event_t * const event = rcl_graph_event_at(events_current);

    fits = events_request(event, &request);
    events_address(event, &request);
    event->is_requested = fits;
    event->is_due = fits; /* a name that cannot be asked for is not tried again before a change */
    event->graph = graph;
    if (!fits) {
      xrce_turn_stored(event->endpoint->client); /* the next one that is due */
    }
  }
  microros_unlock();
  if (!fits) {
    return;
  }
  events_graph = graph;
  events_wait = rcl_send_request(&events_client, &request, &events_sequence_number) == RCL_RET_OK;
  if (!events_wait) {
    rcl_reset_error(); /* no session, or no room: later */
  }
  events_rest(now);
}

static void events_follow(uint32_t now)
{
  if (rmw_requester_is_ready(events_client.impl)) {
    events_take(now);
  }
  if (!events_pause || xrce_is_due(now, events_due_ms)) {
    if (events_wait && events_silences != (uint8_t)EVENTS_SILENCES) {
      ++events_silences;
    }
    events_wait = false;
    events_set_pause(false);
    if (xrce_write_has_room(events_client.impl->data)) {
      events_ask(rcl_graph_changes(), now);
    } else {
      events_rest(now);
    }
  }
}

void rcl_graph_events_follow(void)
{
  if (!events_begin()) {
    return;
  }
  if (rcl_client_is_valid(&events_client)) { /* the node is open, and stays so meanwhile */
    events_follow(port_time_ms());
  }
  events_end();
}

uint32_t rcl_graph_events_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  (void)client;
  return events_pause ? xrce_sooner(left, events_due_ms, now) : left;
}
