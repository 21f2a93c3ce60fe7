/* SPDX-License-Identifier: Apache-2.0 */
/* Guard conditions: wake a waiting task from another task or an interrupt. */
#ifndef MICROROS_RCL_GUARD_CONDITION_H
#define MICROROS_RCL_GUARD_CONDITION_H

#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_guard_condition_impl_s rcl_guard_condition_impl_t;

typedef struct rcl_guard_condition_s {
  rcl_context_t * context;
  rcl_guard_condition_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_guard_condition_t;

typedef struct rcl_guard_condition_options_s {
  rcl_allocator_t allocator;
} rcl_guard_condition_options_t;

rcl_guard_condition_t rcl_get_zero_initialized_guard_condition(void);

/*
 * Uses one of `pools: {guard_conditions: N}`; RCL_RET_BAD_ALLOC if all are in use. `guard_condition` must
 * be zero-initialized, otherwise RCL_RET_ALREADY_INIT; RCL_RET_NOT_INIT for an invalid context. Does not
 * wait.
 */
rcl_ret_t rcl_guard_condition_init(
  rcl_guard_condition_t * guard_condition, rcl_context_t * context,
  const rcl_guard_condition_options_t options);

/* Frees the place. Returns RCL_RET_OK for one that is not initialized, too. */
rcl_ret_t rcl_guard_condition_fini(rcl_guard_condition_t * guard_condition);

rcl_guard_condition_options_t rcl_guard_condition_get_default_options(void);

/* Makes it ready until rcl_wait or an executor has seen it, and wakes the waiting task. Callable from any
 * task and from an interrupt. */
rcl_ret_t rcl_trigger_guard_condition(rcl_guard_condition_t * guard_condition);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GUARD_CONDITION_H */
