/* SPDX-License-Identifier: Apache-2.0 */
/* QoS on its way to the agent. Internal. */
#ifndef MICROROS_RMW_QOS_H
#define MICROROS_RMW_QOS_H

#include <stdint.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Gives the flags and depth that XRCE carries for `qos`; returns NULL, or the name of a policy that it cannot
 * carry. */
const char * rmw_qos_to_xrce(const rmw_qos_profile_t * qos, uint8_t * flags, uint16_t * depth);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_QOS_H */
