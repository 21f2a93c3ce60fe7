/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/lock.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_wire.h"

#include <string.h>


static void qos_actual(const xrce_endpoint_t * endpoint, rmw_qos_profile_t * qos)
{
  static const struct rmw_time_s unlimited = RMW_DURATION_INFINITE;
  const uint8_t flags = endpoint->qos;

  (void)memset(qos, 0, sizeof(*qos));
  qos->reliability = (flags & XRCE_QOS_RELIABLE) != 0u ? RMW_QOS_POLICY_RELIABILITY_RELIABLE
                                                       : RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  qos->history =
    (flags & XRCE_QOS_KEEP_LAST) != 0u ? RMW_QOS_POLICY_HISTORY_KEEP_LAST : RMW_QOS_POLICY_HISTORY_KEEP_ALL;
  qos->durability = (flags & XRCE_QOS_TRANSIENT_LOCAL) != 0u ? RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL
                                                             : RMW_QOS_POLICY_DURABILITY_VOLATILE;
  qos->depth = endpoint->depth;
  qos->deadline = unlimited;
  qos->lifespan = unlimited;
  qos->liveliness = RMW_QOS_POLICY_LIVELINESS_AUTOMATIC;
  qos->liveliness_lease_duration = unlimited;
}

void rmw_qos_actual(const xrce_endpoint_t * endpoint, rmw_qos_profile_t * qos)
{
  microros_lock();
  qos_actual(endpoint, qos);
  microros_unlock();
}
