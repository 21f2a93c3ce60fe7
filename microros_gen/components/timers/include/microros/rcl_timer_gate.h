/* SPDX-License-Identifier: Apache-2.0 */
/* Whether a timer may become ready now: always, unless a component replaces this header. Internal. */
#ifndef MICROROS_RCL_TIMER_GATE_H
#define MICROROS_RCL_TIMER_GATE_H

#include <stdbool.h>

#include "microros/rcl_timer.h"

/* Called for a new timer, whose period is set. */
static inline void rcl_timer_gate_begin(const rcl_timer_impl_t * timer)
{
  (void)timer;
}

static inline bool rcl_timer_gate_is_open(const rcl_timer_impl_t * timer)
{
  (void)timer;
  return true;
}

#endif /* MICROROS_RCL_TIMER_GATE_H */
