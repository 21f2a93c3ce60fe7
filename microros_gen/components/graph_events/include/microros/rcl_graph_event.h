/* SPDX-License-Identifier: Apache-2.0 */
/* Events that a graph server tells of. Replaces the header of component `qos_events`. Internal. */
#ifndef MICROROS_RCL_GRAPH_EVENT_H
#define MICROROS_RCL_GRAPH_EVENT_H

#include <stdbool.h>

#include "microros/xrce_deadlines.h"
#include "rcl/event.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Begins to observe an open publisher or subscription: what does not match because of its QoS, or what matches.
 * RCL_RET_ALREADY_INIT, with a text. */
rcl_ret_t rcl_graph_event_open(rcl_event_t * event, const xrce_endpoint_t * endpoint, bool is_incompatible);

/* Returns whether it is such an event, and has written its status. */
bool rcl_graph_event_take(const xrce_deadline_t * event, void * event_info);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_EVENT_H */
