/* SPDX-License-Identifier: Apache-2.0 */
/* What rclc and rcl share: opening with options of rmw, or without any, which then are not linked. Internal;
 * pointers are not NULL. */
#ifndef MICROROS_RCL_OPEN_H
#define MICROROS_RCL_OPEN_H

#include "rcl/context.h"

#ifdef __cplusplus
extern "C" {
#endif

rcl_ret_t rcl_open(const rmw_init_options_t * options, rcl_context_t * context);

/* The same, everything as the plan says. */
rcl_ret_t rcl_open_as_planned(rcl_context_t * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_OPEN_H */
