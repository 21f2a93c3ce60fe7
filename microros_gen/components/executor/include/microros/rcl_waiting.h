/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Waiting, for whoever looks at entities until one is ready: begin; then receive, look, and rest, until it is over.
 * Internal.
 */
#ifndef MICROROS_RCL_WAITING_H
#define MICROROS_RCL_WAITING_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_waiting_t {
  uint32_t start_ms;
  uint32_t timeout_ms; /* UINT32_MAX: it never ends by itself */
} rcl_waiting_t;

/* `timeout_ns` negative: as long as it takes. Times are rounded up to milliseconds; 49 days and more are for ever. */
rcl_waiting_t rcl_waiting_begin(int64_t timeout_ns);

/* Receives what has come. */
void rcl_waiting_receive(void);

/* Whether the time is up. */
bool rcl_waiting_is_over(const rcl_waiting_t * waiting);

/* Rests, at most until the time is up, and at most `look_again_ns`. */
void rcl_waiting_rest(const rcl_waiting_t * waiting, int64_t look_again_ns);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAITING_H */
