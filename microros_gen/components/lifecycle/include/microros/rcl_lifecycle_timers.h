/* SPDX-License-Identifier: Apache-2.0 */
/* Managed timers begin with a whole period when their node becomes active. Internal. */
#ifndef MICROROS_RCL_LIFECYCLE_TIMERS_H
#define MICROROS_RCL_LIFECYCLE_TIMERS_H

#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called when a node has become active. */
void rcl_lifecycle_timers_start(const rcl_node_t * node);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_TIMERS_H */
