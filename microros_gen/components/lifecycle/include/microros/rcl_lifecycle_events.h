/* SPDX-License-Identifier: Apache-2.0 */
/* Events of transitions: one change of state has up to four, which may be more than the stream has room for. They wait
 * in order, until there is room. Internal. */
#ifndef MICROROS_RCL_LIFECYCLE_EVENTS_H
#define MICROROS_RCL_LIFECYCLE_EVENTS_H

#include <stdint.h>

#include "rcl_lifecycle/data_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sends the event of one of rcl_lifecycle_transitions now or later. Where too many wait, the oldest is dropped and
 * counted. */
void rcl_lifecycle_events_add(
  rcl_lifecycle_com_interface_t * offers, const rcl_lifecycle_transition_t * transition);

/* Sends what waits, as far as there is room. */
void rcl_lifecycle_events_send(rcl_lifecycle_com_interface_t * offers);

/* Drops what waits of a node. */
void rcl_lifecycle_events_clear(const rcl_node_t * node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_EVENTS_H */
