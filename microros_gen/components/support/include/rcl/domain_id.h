/* SPDX-License-Identifier: Apache-2.0 */
/* Domain of a node that sets none. */
#ifndef MICROROS_RCL_DOMAIN_ID_H
#define MICROROS_RCL_DOMAIN_ID_H

#include <stddef.h>

#include "rcl/types.h"
#include "rmw/domain_id.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCL_DEFAULT_DOMAIN_ID RMW_DEFAULT_DOMAIN_ID

/* Leaves *domain_id unchanged, as ROS 2 does without ROS_DOMAIN_ID: a microcontroller has no environment.
 * RCL_RET_INVALID_ARGUMENT for NULL. */
rcl_ret_t rcl_get_default_domain_id(size_t * domain_id);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_DOMAIN_ID_H */
