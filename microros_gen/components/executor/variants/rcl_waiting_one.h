/* SPDX-License-Identifier: Apache-2.0 */
/* What is known of a wait, and how it rests; one task. For rcl_waiting only. */
#ifndef MICROROS_RCL_WAITING_STATE_H
#define MICROROS_RCL_WAITING_STATE_H

#include <stdint.h>

#include "microros/rmw_client_wait.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_waiting_t {
  uint32_t start_ms;
  uint32_t timeout_ms; /* UINT32_MAX: no time-out */
} rcl_waiting_t;

static inline rcl_waiting_t rcl_waiting_of(uint32_t start_ms, uint32_t timeout_ms)
{
  const rcl_waiting_t waiting = {start_ms, timeout_ms};

  return waiting;
}

static inline void rcl_waiting_sleep(rcl_waiting_t * waiting, uint32_t timeout_ms)
{
  (void)waiting;
  rmw_client_wait(timeout_ms);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAITING_STATE_H */
