/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Waiting until one of several entities is ready: begin; then receive, look and rest, until it is over.
 * Internal.
 */
#ifndef MICROROS_RCL_WAITING_H
#define MICROROS_RCL_WAITING_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/rcl_waiting_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Negative `timeout_ns`: no time-out. Times are rounded up to milliseconds; 49 days and more mean no
 * time-out. */
rcl_waiting_t rcl_waiting_begin(int64_t timeout_ns);

/* Receives without waiting. */
void rcl_waiting_receive(void);

/* Returns whether the time-out has expired. */
bool rcl_waiting_is_over(const rcl_waiting_t * waiting);

/* Rests until the time-out at most, and for at most `look_again_ns`. */
void rcl_waiting_rest(rcl_waiting_t * waiting, int64_t look_again_ns);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAITING_H */
