/* SPDX-License-Identifier: Apache-2.0 */
/* Managed timers are ready while their node is active. Internal. */
#ifndef MICROROS_RCL_TIMER_GATE_H
#define MICROROS_RCL_TIMER_GATE_H

#include <stdbool.h>

#include "microros/rcl_timer.h"

/* Called for a new timer: it is managed if the declaration with its period is. */
void rcl_timer_gate_begin(const rcl_timer_impl_t * timer);

bool rcl_timer_gate_is_open(const rcl_timer_impl_t * timer);

#endif /* MICROROS_RCL_TIMER_GATE_H */
