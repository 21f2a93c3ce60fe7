/* SPDX-License-Identifier: Apache-2.0 */
/* A context: one per process at a time, since it represents one session with one agent. */
#ifndef MICROROS_RCL_CONTEXT_H
#define MICROROS_RCL_CONTEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcl/allocator.h"
#include "rcl/arguments.h"
#include "rcl/init_options.h"
#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"
#include "rmw/init.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef uint64_t rcl_context_instance_id_t;

typedef struct rmw_context_s rcl_context_impl_t;

typedef struct rcl_context_s {
  rcl_arguments_t global_arguments;
  rcl_context_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_context_t;

rcl_context_t rcl_get_zero_initialized_context(void);

/* RCL_RET_INVALID_ARGUMENT for a context that was not shut down. */
rcl_ret_t rcl_context_fini(rcl_context_t * context);

/* Returns a number that is unique among the contexts of this run; 0 for a context that is not initialized. */
rcl_context_instance_id_t rcl_context_get_instance_id(const rcl_context_t * context);

rcl_ret_t rcl_context_get_domain_id(rcl_context_t * context, size_t * domain_id);

bool rcl_context_is_valid(const rcl_context_t * context);

/* Returns the context for functions of rmw_microros; NULL for a context that is not initialized. */
rmw_context_t * rcl_context_get_rmw_context(rcl_context_t * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CONTEXT_H */
