/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/subscription.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_subscription.h"
#include "microros/xrce_read.h"

#include <stddef.h>

rmw_ret_t rmw_uros_get_subscription_statistics(
  const rmw_subscription_t * subscription, rmw_uros_subscription_statistics_t * statistics)
{
  xrce_read_counters_t counted;

  if (!rmw_subscription_is_open(subscription) || statistics == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "subscription or statistics");
  }
  microros_lock();
  counted = xrce_read_counters(subscription->data);
  microros_unlock();
  statistics->dropped = counted.dropped;
  statistics->refused = counted.refused;
  return RMW_RET_OK;
}
