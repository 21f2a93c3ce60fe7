/* SPDX-License-Identifier: Apache-2.0 */
/* Events of a wait set. Replaces the header of component `executor`. Internal. */
#ifndef MICROROS_RCL_WAIT_EVENTS_H
#define MICROROS_RCL_WAIT_EVENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "microros/rcl_event_places.h"
#include "microros/rcl_wait_set.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns how many it has room for. */
static inline size_t rcl_wait_events_size(const rcl_wait_set_t * wait_set)
{
  return wait_set->size_of_events;
}

/* Removes all; the size stays. */
void rcl_wait_events_clear(const rcl_wait_set_t * wait_set);

/* Sets the size of one without any. */
void rcl_wait_events_resize(rcl_wait_set_t * wait_set, size_t size);

/* Returns whether one is ready: something has happened since it was last taken. `settles`: those that are not become
 * NULL. */
bool rcl_wait_events_look(const rcl_wait_set_t * wait_set, bool settles);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAIT_EVENTS_H */
