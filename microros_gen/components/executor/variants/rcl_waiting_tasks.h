/* SPDX-License-Identifier: Apache-2.0 */
/* What is known of a wait, and how it rests; several tasks. For rcl_waiting only. */
#ifndef MICROROS_RCL_WAITING_STATE_H
#define MICROROS_RCL_WAITING_STATE_H

#include <stdint.h>

#include "microros/lock.h"
#include "microros/rmw_client_wait.h"
#include "microros/wake.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_waiting_t {
  uint32_t start_ms;
  uint32_t timeout_ms; /* UINT32_MAX: no time-out */
  uint32_t news;       /* counted when this task last began to look */
} rcl_waiting_t;

static inline rcl_waiting_t rcl_waiting_of(uint32_t start_ms, uint32_t timeout_ms)
{
  rcl_waiting_t waiting = {start_ms, timeout_ms, 0};

  microros_lock();
  waiting.news = microros_news();
  microros_unlock();
  return waiting;
}

static inline void rcl_waiting_sleep(rcl_waiting_t * waiting, uint32_t timeout_ms)
{
  rmw_client_wait_news(timeout_ms, &waiting->news);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAITING_STATE_H */
