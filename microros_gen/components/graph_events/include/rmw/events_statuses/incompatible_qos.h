/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_RMW_EVENTS_STATUSES_INCOMPATIBLE_QOS_H
#define MICROROS_RMW_EVENTS_STATUSES_INCOMPATIBLE_QOS_H

#include <stdint.h>

#include "rmw/qos_policy_kind.h"

/* Endpoints with other QoS since the event was initialized, and since it was last taken. */
typedef struct rmw_qos_incompatible_event_status_s {
  int32_t total_count;
  int32_t total_count_change;
  rmw_qos_policy_kind_t last_policy_kind; /* of the newest; RMW_QOS_POLICY_INVALID without any */
} rmw_qos_incompatible_event_status_t;

typedef rmw_qos_incompatible_event_status_t rmw_requested_qos_incompatible_event_status_t;
typedef rmw_qos_incompatible_event_status_t rmw_offered_qos_incompatible_event_status_t;

#endif /* MICROROS_RMW_EVENTS_STATUSES_INCOMPATIBLE_QOS_H */
