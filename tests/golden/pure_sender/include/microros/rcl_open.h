/* SPDX-License-Identifier: Apache-2.0 */
/* What rclc and rcl share: opening without options of rcl. Internal; pointers are checked here, except as
 * said. */
#ifndef MICROROS_RCL_OPEN_H
#define MICROROS_RCL_OPEN_H

#include "rcl/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/* `options` NULL: as the plan says. */
rcl_ret_t rcl_open(const rmw_init_options_t * options, rcl_context_t * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_OPEN_H */
