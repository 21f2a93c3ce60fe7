/* SPDX-License-Identifier: Apache-2.0 */
/* Options of a context. They contain everything by value; rcl_init_options_fini has nothing to free. */
#ifndef MICROROS_RCL_INIT_OPTIONS_H
#define MICROROS_RCL_INIT_OPTIONS_H

#include <stddef.h>

#include "rcl/allocator.h"
#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"
#include "rmw/init.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_init_options_s {
  rmw_init_options_t rmw;
} rcl_init_options_t;

rcl_init_options_t rcl_get_zero_initialized_init_options(void);

/* RCL_RET_ALREADY_INIT for options that are in use: zero-initialize or finalize them first. */
rcl_ret_t rcl_init_options_init(rcl_init_options_t * init_options, rcl_allocator_t allocator);

rcl_ret_t rcl_init_options_copy(const rcl_init_options_t * src, rcl_init_options_t * dst);

rcl_ret_t rcl_init_options_fini(rcl_init_options_t * init_options);

rcl_ret_t rcl_init_options_get_domain_id(const rcl_init_options_t * init_options, size_t * domain_id);

/* Overrides the domain of the application file. 0 to 232; 255: that of the agent (its ROS_DOMAIN_ID);
 * RCL_DEFAULT_DOMAIN_ID: that of the application file. */
rcl_ret_t rcl_init_options_set_domain_id(rcl_init_options_t * init_options, size_t domain_id);

/* Returns the options for rmw_microros/init_options.h; NULL for options that are not initialized. */
rmw_init_options_t * rcl_init_options_get_rmw_init_options(rcl_init_options_t * init_options);

const rcl_allocator_t * rcl_init_options_get_allocator(const rcl_init_options_t * init_options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_INIT_OPTIONS_H */
