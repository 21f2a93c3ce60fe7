/* SPDX-License-Identifier: Apache-2.0 */
/* State of a wait set; internal. */
#ifndef MICROROS_RCL_WAIT_SET_H
#define MICROROS_RCL_WAIT_SET_H

#include "microros_config.h"
#include "rcl/wait.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The arrays, and the number of added entities of each kind. */
struct rcl_wait_set_impl_s {
  const rcl_subscription_t * subscriptions[MICROROS_SUBSCRIPTIONS_MAX];
  size_t subscription_count;
  const rcl_timer_t * timers[MICROROS_TIMERS_MAX];
  size_t timer_count;
  bool taken;
};

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAIT_SET_H */
