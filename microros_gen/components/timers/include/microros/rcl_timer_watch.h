/* SPDX-License-Identifier: Apache-2.0 */
/* Who observes how late timers are called: nobody, unless a component replaces this header. Internal. */
#ifndef MICROROS_RCL_TIMER_WATCH_H
#define MICROROS_RCL_TIMER_WATCH_H

#include "microros/rcl_timer.h"

/* Called for a timer that is called at `now` of its clock, before the time of its next call is set. */
static inline void rcl_timer_watch(const rcl_timer_impl_t * timer, int64_t now)
{
  (void)timer;
  (void)now;
}

#endif /* MICROROS_RCL_TIMER_WATCH_H */
