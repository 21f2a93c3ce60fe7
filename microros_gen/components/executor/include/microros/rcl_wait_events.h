/* SPDX-License-Identifier: Apache-2.0 */
/* Events of a wait set: none without the component `qos_events`, which replaces this header. Internal. */
#ifndef MICROROS_RCL_WAIT_EVENTS_H
#define MICROROS_RCL_WAIT_EVENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "microros/rcl_wait_set.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How many a wait set takes. */
enum { RCL_WAIT_EVENTS_MAX = 0 };

/* Returns how many it has room for. */
static inline size_t rcl_wait_events_size(const rcl_wait_set_t * wait_set)
{
  (void)wait_set;
  return 0;
}

/* Removes all; the size stays. */
static inline void rcl_wait_events_clear(const rcl_wait_set_t * wait_set)
{
  (void)wait_set;
}

/* Sets the size of one without any. */
static inline void rcl_wait_events_resize(rcl_wait_set_t * wait_set, size_t size)
{
  (void)wait_set;
  (void)size;
}

/* Returns whether one is ready; `settles`: those that are not become NULL. */
static inline bool rcl_wait_events_look(const rcl_wait_set_t * wait_set, bool settles)
{
  (void)wait_set;
  (void)settles;
  return false;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAIT_EVENTS_H */
