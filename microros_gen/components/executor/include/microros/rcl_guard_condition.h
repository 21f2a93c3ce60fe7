/* SPDX-License-Identifier: Apache-2.0 */
/* Guard conditions, for waiting functions; internal. */
#ifndef MICROROS_RCL_GUARD_CONDITION_INTERNAL_H
#define MICROROS_RCL_GUARD_CONDITION_INTERNAL_H

#include <stdbool.h>
#include <stdint.h>

#include "rcl/guard_condition.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Counters of triggers and of seen triggers: the triggering context writes only the first, the waiting
 * task only the second. */
struct rcl_guard_condition_impl_s {
  volatile uint32_t triggered;
  uint32_t seen;
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
