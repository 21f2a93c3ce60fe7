/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_qos.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/xrce_wire.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* Unset or practically infinite: RMW_DURATION_INFINITE has more than 2^33 seconds. */
static bool qos_is_unlimited(const struct rmw_time_s * time)
{
  return (time->sec | time->nsec) == 0u || time->sec >> 33 != 0u;
}

static const char * qos_refuse(const rmw_qos_profile_t * qos)
{
  if (qos->reliability > RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT) {
    return MICROROS_ERROR_WORDS("reliability");
  }
  if (qos->durability > RMW_QOS_POLICY_DURABILITY_VOLATILE) {
    return MICROROS_ERROR_WORDS("durability");
  }
  if (qos->history > RMW_QOS_POLICY_HISTORY_KEEP_ALL) {
    return MICROROS_ERROR_WORDS("history");
  }
  if (qos->depth > UINT16_MAX) {
    return MICROROS_ERROR_WORDS("depth");
  }
  if (!qos_is_unlimited(&qos->deadline)) {
    return MICROROS_ERROR_WORDS("deadline");
  }
  if (!qos_is_unlimited(&qos->lifespan)) {
    return MICROROS_ERROR_WORDS("lifespan");
  }
  if (
    qos->liveliness > RMW_QOS_POLICY_LIVELINESS_AUTOMATIC ||
    !qos_is_unlimited(&qos->liveliness_lease_duration)) {
    return MICROROS_ERROR_WORDS("liveliness");
  }
  return qos->avoid_ros_namespace_conventions ? MICROROS_ERROR_WORDS("avoid_ros_namespace_conventions") : NULL;
}

const char * rmw_qos_to_xrce(const rmw_qos_profile_t * qos, uint8_t * flags, uint16_t * depth)
{
  const char * refused = qos_refuse(qos);

  if (refused != NULL) {
    return refused;
  }
  *flags = 0;
  if (qos->reliability != RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT) {
    *flags |= XRCE_QOS_RELIABLE;
  }
  if (qos->history != RMW_QOS_POLICY_HISTORY_KEEP_ALL) {
    *flags |= XRCE_QOS_KEEP_LAST;
  }
  if (qos->durability == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL) {
    *flags |= XRCE_QOS_TRANSIENT_LOCAL;
  }
  *depth = (uint16_t)qos->depth;
  return NULL;
}

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

const rmw_qos_profile_t * rmw_qos_default(void)
{
  return &rmw_qos_profile_default;
}
