/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_event.h"
#include "microros/rcl_graph_event.h"

#include <stddef.h>

/* Returns why this type has no event; NULL if it has one. */
static const char * publisher_event_refusal(rcl_publisher_event_type_t event_type)
{
  switch (event_type) {
    case RCL_PUBLISHER_OFFERED_DEADLINE_MISSED:
    case RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS:
    case RCL_PUBLISHER_MATCHED:
      return NULL;
    case RCL_PUBLISHER_LIVELINESS_LOST:
      return MICROROS_ERROR_WORDS("liveliness: XRCE carries none");
    case RCL_PUBLISHER_INCOMPATIBLE_TYPE:
    default:
      return MICROROS_ERROR_WORDS("incompatible type: XRCE reports none");
  }
}

rcl_ret_t rcl_publisher_event_init(
  rcl_event_t * event, const rcl_publisher_t * publisher, const rcl_publisher_event_type_t event_type)
{
  const char * refusal = publisher_event_refusal(event_type);

  if (event == NULL) {
    return microros_error_refuse(RCL_RET_EVENT_INVALID, "event");
  }
  if (!rcl_publisher_is_valid(publisher)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "publisher");
  }
  if (refusal != NULL) {
    return microros_error_named(RCL_RET_UNSUPPORTED, microros_error_event, refusal);
  }
  if (event_type == RCL_PUBLISHER_OFFERED_DEADLINE_MISSED) {
    return rcl_event_open(event, publisher->impl->data);
  }
  return rcl_graph_event_open(event, publisher->impl->data, event_type != RCL_PUBLISHER_MATCHED);
}
