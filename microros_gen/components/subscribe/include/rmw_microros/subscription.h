/* SPDX-License-Identifier: Apache-2.0 */
/* Statistics of a subscription: an addition of this client to rmw_microros. */
#ifndef MICROROS_RMW_MICROROS_SUBSCRIPTION_H
#define MICROROS_RMW_MICROROS_SUBSCRIPTION_H

#include <stdint.h>

#include "rmw/ret_types.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Samples since the subscription was opened; each counter wraps to 0 after 2^32 - 1. `dropped` of
 * rmw_uros_get_statistics counts both, too. */
typedef struct rmw_uros_subscription_statistics_t {
  uint32_t dropped; /* the queue was full: a best-effort subscription drops the oldest sample */
  uint32_t refused; /* above the limits, or not decodable */
} rmw_uros_subscription_statistics_t;

rmw_ret_t rmw_uros_get_subscription_statistics(
  const rmw_subscription_t * subscription, rmw_uros_subscription_statistics_t * statistics);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SUBSCRIPTION_H */
