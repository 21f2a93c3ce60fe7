/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by rclc and rcl: opens a session with options of rmw, or without, in which case options are not
 * linked. Internal; pointers are not NULL. */
#ifndef MICROROS_RCL_OPEN_H
#define MICROROS_RCL_OPEN_H

#include "rcl/context.h"

#ifdef __cplusplus
extern "C" {
#endif

rcl_ret_t rcl_open(const rmw_init_options_t * options, rcl_context_t * context);

/* Same, with the plan's settings only. */
rcl_ret_t rcl_open_as_planned(rcl_context_t * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_OPEN_H */
