/* SPDX-License-Identifier: Apache-2.0 */
/* Managed timers begin with a whole period when their node becomes active; what they skip is counted. Internal. */
#ifndef MICROROS_RCL_LIFECYCLE_TIMERS_H
#define MICROROS_RCL_LIFECYCLE_TIMERS_H

#include <stdint.h>

#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called when a node has become active. */
void rcl_lifecycle_timers_start(const rcl_node_t * node);

/* Returns the skipped calls of all managed timers; wraps, and begins again with a timer. Any task. */
uint32_t rcl_lifecycle_timers_skipped(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_TIMERS_H */
