/* SPDX-License-Identifier: Apache-2.0 */
/* Conversion of QoS for the agent. Internal. */
#ifndef MICROROS_RMW_QOS_H
#define MICROROS_RMW_QOS_H

#include <stdint.h>

#include "microros/xrce_objects.h"
#include "rmw/qos_profiles.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sets the flags and depth that XRCE carries for `qos`; returns NULL, or the name of an unsupported
 * policy. */
const char * rmw_qos_to_xrce(const rmw_qos_profile_t * qos, uint8_t * flags, uint16_t * depth);

/* The same for deadline and lifespan; does nothing if no endpoint of the plan has either. */
static inline void rmw_qos_add_times(const rmw_qos_profile_t * qos, const xrce_endpoint_t * endpoint)
{
  (void)qos;
  (void)endpoint;
}

/* Fills in the QoS of the endpoint with defaults resolved, for getters. */
void rmw_qos_actual(const xrce_endpoint_t * endpoint, rmw_qos_profile_t * qos);

/* Returns rmw_qos_profile_default. Each file that includes rmw/qos_profiles.h and names it has a copy of it. */
const rmw_qos_profile_t * rmw_qos_default(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_QOS_H */
