/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_objects.h"
#include "rcl/subscription.h"

#include <stddef.h>

const rmw_qos_profile_t * rcl_subscription_get_actual_qos(const rcl_subscription_t * subscription)
{
  static rmw_qos_profile_t profiles[MICROROS_SUBSCRIPTIONS_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rmw_qos_profile_t * profile;

  if (!rcl_subscription_is_valid(subscription)) {
    (void)microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
    return NULL;
  }
  endpoint = subscription->impl->data;
  profile = &profiles[MICROROS_NODES_MAX + endpoint->index - XRCE_READERS_AT];
  rmw_qos_actual(endpoint, profile);
  return profile;
}
