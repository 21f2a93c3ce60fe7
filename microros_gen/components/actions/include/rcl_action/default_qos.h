/* SPDX-License-Identifier: Apache-2.0 */
/* Quality of service of the topic on which a server publishes the states of its goals. */
#ifndef MICROROS_RCL_ACTION_DEFAULT_QOS_H
#define MICROROS_RCL_ACTION_DEFAULT_QOS_H

#include "rmw/qos_profiles.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The last status reaches a client that comes later. */
static const rmw_qos_profile_t rcl_action_qos_profile_status_default = {
  RMW_QOS_POLICY_HISTORY_KEEP_LAST,
  1,
  RMW_QOS_POLICY_RELIABILITY_RELIABLE,
  RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL,
  RMW_QOS_DEADLINE_DEFAULT,
  RMW_QOS_LIFESPAN_DEFAULT,
  RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
  RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
  false};

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_DEFAULT_QOS_H */
