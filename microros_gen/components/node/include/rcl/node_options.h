/* SPDX-License-Identifier: Apache-2.0 */
/* Options of a node. */
#ifndef MICROROS_RCL_NODE_OPTIONS_H
#define MICROROS_RCL_NODE_OPTIONS_H

#include <stdbool.h>

#include "rcl/allocator.h"
#include "rcl/arguments.h"
#include "rcl/domain_id.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCL_NODE_OPTIONS_DEFAULT_DOMAIN_ID RCL_DEFAULT_DOMAIN_ID

/* For sources that fill it in: arguments are not read, the allocator is never called. */
typedef struct rcl_node_options_s {
  rcl_allocator_t allocator;
  bool use_global_arguments;
  rcl_arguments_t arguments;
  bool enable_rosout;
  rmw_qos_profile_t rosout_qos;
} rcl_node_options_t;

rcl_node_options_t rcl_node_get_default_options(void);

rcl_ret_t rcl_node_options_copy(const rcl_node_options_t * options, rcl_node_options_t * options_out);

rcl_ret_t rcl_node_options_fini(rcl_node_options_t * options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_NODE_OPTIONS_H */
