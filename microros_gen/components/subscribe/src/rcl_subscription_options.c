/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_objects.h"
#include "rcl/subscription.h"

#include <stddef.h>

const rcl_subscription_options_t * rcl_subscription_get_options(const rcl_subscription_t * subscription)
{
  static rcl_subscription_options_t options[MICROROS_SUBSCRIPTIONS_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rcl_subscription_options_t * own;

  if (!rcl_subscription_is_valid(subscription)) {
    (void)microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
    return NULL;
  }
  endpoint = subscription->impl->data;
  own = &options[MICROROS_NODES_MAX + endpoint->index - XRCE_READERS_AT];
  own->allocator = rcl_get_default_allocator();
  rmw_qos_actual(endpoint, &own->qos);
  return own;
}
