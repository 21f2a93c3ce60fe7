/* SPDX-License-Identifier: Apache-2.0 */
/* Observes how late timers are called. Internal. */
#ifndef MICROROS_RCL_TIMER_WATCH_H
#define MICROROS_RCL_TIMER_WATCH_H

#include "microros/rcl_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called for a timer that is called at `now` of its clock, before the time of its next call is set. */
void rcl_timer_watch(const rcl_timer_impl_t * timer, int64_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_TIMER_WATCH_H */
