/* SPDX-License-Identifier: Apache-2.0 */
/* Guard conditions, for waiting functions; internal. */
#ifndef MICROROS_RCL_GUARD_CONDITION_INTERNAL_H
#define MICROROS_RCL_GUARD_CONDITION_INTERNAL_H

#include <stdbool.h>

#include "microros/shared_flag.h"
#include "rcl/guard_condition.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The triggering context sets the flag, the waiting task clears it. */
struct rcl_guard_condition_impl_s {
  microros_shared_flag_t is_triggered;
  bool taken;
};

bool rcl_guard_condition_is_valid(const rcl_guard_condition_t * guard_condition);

/* Returns whether a valid guard condition was triggered since it was last seen. */
bool rcl_guard_condition_is_ready(const rcl_guard_condition_t * guard_condition);

void rcl_guard_condition_acknowledge(const rcl_guard_condition_t * guard_condition);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GUARD_CONDITION_INTERNAL_H */
