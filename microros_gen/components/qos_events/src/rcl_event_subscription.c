/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_event.h"
#include "microros/rcl_graph_event.h"

#include <stddef.h>

/* Returns why this type has no event; NULL if it has one. */
static const char * subscription_event_refusal(rcl_subscription_event_type_t event_type)
{
  switch (event_type) {
    case RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED:
    case RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS:
    case RCL_SUBSCRIPTION_MATCHED:
      return NULL;
    case RCL_SUBSCRIPTION_LIVELINESS_CHANGED:
      return MICROROS_ERROR_WORDS("liveliness: XRCE carries none");
    case RCL_SUBSCRIPTION_MESSAGE_LOST:
      return MICROROS_ERROR_WORDS("lost messages: XRCE reports none");
    case RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE:
    default:
      return MICROROS_ERROR_WORDS("incompatible type: XRCE reports none");
  }
}

rcl_ret_t rcl_subscription_event_init(
  rcl_event_t * event, const rcl_subscription_t * subscription,
  const rcl_subscription_event_type_t event_type)
{
  const char * refusal = subscription_event_refusal(event_type);

  if (event == NULL) {
    return microros_error_refuse(RCL_RET_EVENT_INVALID, "event");
  }
  if (!rcl_subscription_is_valid(subscription)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "subscription");
  }
  if (refusal != NULL) {
    return microros_error_named(RCL_RET_UNSUPPORTED, microros_error_event, refusal);
  }
  if (event_type == RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED) {
    return rcl_event_open(event, subscription->impl->data);
  }
  return rcl_graph_event_open(event, subscription->impl->data, event_type != RCL_SUBSCRIPTION_MATCHED);
}
