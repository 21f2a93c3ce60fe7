/* SPDX-License-Identifier: Apache-2.0 */
/* Events that a graph server tells of: none without the component `graph_events`, which replaces this header.
 * Internal. */
#ifndef MICROROS_RCL_GRAPH_EVENT_H
#define MICROROS_RCL_GRAPH_EVENT_H

#include "microros/error.h"
#include "microros/xrce_deadlines.h"
#include "rcl/event.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Refuses to observe the endpoint, with a text. */
static inline rcl_ret_t rcl_graph_event_open(
  rcl_event_t * event, const xrce_endpoint_t * endpoint, bool is_incompatible)
{
  (void)event;
  (void)endpoint;
  return microros_error_named(
    RCL_RET_UNSUPPORTED, microros_error_event,
    is_incompatible
      ? MICROROS_ERROR_WORDS("incompatible QoS: XRCE reports none: add component graph_events")
      : MICROROS_ERROR_WORDS("matched endpoints: XRCE reports none: add component graph_events"));
}

/* Returns whether it is such an event, and has written its status. */
static inline bool rcl_graph_event_take(const xrce_deadline_t * event, void * event_info)
{
  (void)event;
  (void)event_info;
  return false;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_EVENT_H */
