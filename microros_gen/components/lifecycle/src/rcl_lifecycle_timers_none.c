/* SPDX-License-Identifier: Apache-2.0 */
/* No timer is managed. */
#include "microros/rcl_lifecycle_timers.h"

void rcl_lifecycle_timers_start(const rcl_node_t * node)
{
  (void)node;
}
