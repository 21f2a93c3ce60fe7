/* SPDX-License-Identifier: Apache-2.0 */
/* What is known of the endpoints that are observed. Internal. */
#ifndef MICROROS_RCL_GRAPH_EVENTS_H
#define MICROROS_RCL_GRAPH_EVENTS_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_deadlines.h"
#include "microros_graph_msgs/srv/endpoint_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Two for each publisher and subscription: what matches, and what does not. */
enum { RCL_GRAPH_EVENTS = 2 * XRCE_DEADLINES };

/* Counts are modulo 2^32. Zero-initialized: not observed. */
typedef struct rcl_graph_event_t {
  xrce_deadline_t base; /* what an rcl_event_t refers to; `total` counts changes */
  const xrce_endpoint_t * endpoint;
  uint32_t total;
  uint32_t total_taken;
  uint32_t current;
  uint32_t current_taken;
  uint32_t instance; /* of the graph server; 0: it has not answered yet */
  uint32_t newest;
  uint32_t policy;
  uint32_t graph; /* the change of the graph that the last answer belongs to */
  bool is_incompatible;
  bool is_due;
  bool is_requested; /* a response belongs to this event, not to one that was finalized */
} rcl_graph_event_t;

/* --- under the lock --- */

rcl_graph_event_t * rcl_graph_event_at(uint16_t index);

/* Returns whether the event is observed, and its entity is open. */
bool rcl_graph_event_is_open(const rcl_graph_event_t * event);

/* Takes over a response that has the status OK, and tells the application what has changed. */
void rcl_graph_event_answer(
  rcl_graph_event_t * event, const microros_graph_msgs__srv__EndpointStatus_Response * response);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_EVENTS_H */
