/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_qos.h"

#include "microros/error.h"
#include "microros/xrce_wire.h"

#include <stdbool.h>
#include <stddef.h>

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
