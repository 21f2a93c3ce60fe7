/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wait sets: take messages and call timers without an executor. Several tasks may have one each; one task
 * owns the session.
 */
#ifndef MICROROS_RCL_WAIT_H
#define MICROROS_RCL_WAIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcl/subscription.h"
#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/guard_condition.h"
#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Kind that is not selected: declared for sources that mention it, accepted by no function. */
typedef struct rcl_timer_s {
  void * impl;
} rcl_timer_t;

/* Kind that is not selected: declared for sources that mention it, accepted by no function. */
typedef struct rcl_client_s {
  void * impl;
} rcl_client_t;

/* Kind that is not selected: declared for sources that mention it, accepted by no function. */
typedef struct rcl_service_s {
  void * impl;
} rcl_service_t;

typedef struct rcl_event_s rcl_event_t; /* rcl/event.h, with the component qos_events */

typedef struct rcl_wait_set_impl_s rcl_wait_set_impl_t;

/* After rcl_wait, entries that are not ready are NULL. */
typedef struct rcl_wait_set_s {
  const rcl_subscription_t ** subscriptions;
  size_t size_of_subscriptions;
  const rcl_guard_condition_t ** guard_conditions;
  size_t size_of_guard_conditions;
  const rcl_timer_t ** timers;
  size_t size_of_timers;
  const rcl_client_t ** clients;
  size_t size_of_clients;
  const rcl_service_t ** services;
  size_t size_of_services;
  const rcl_event_t ** events;
  size_t size_of_events;
  rcl_wait_set_impl_t * impl; /* owned by the library; NULL: not initialized */
} rcl_wait_set_t;

rcl_wait_set_t rcl_get_zero_initialized_wait_set(void);

/*
 * Uses one of `pools: {wait_sets: N}`. It has room for as many entities of each kind as the application
 * has: larger numbers return RCL_RET_BAD_ALLOC, as does an exhausted pool. RCL_RET_ALREADY_INIT;
 * RCL_RET_NOT_INIT for an invalid context. `allocator` is not used.
 */
rcl_ret_t rcl_wait_set_init(
  rcl_wait_set_t * wait_set, size_t number_of_subscriptions, size_t number_of_guard_conditions,
  size_t number_of_timers, size_t number_of_clients, size_t number_of_services, size_t number_of_events,
  rcl_context_t * context, rcl_allocator_t allocator);

/* Returns RCL_RET_OK for one that is not initialized, too. */
rcl_ret_t rcl_wait_set_fini(rcl_wait_set_t * wait_set);

rcl_ret_t rcl_wait_set_get_allocator(const rcl_wait_set_t * wait_set, rcl_allocator_t * allocator);

/* Removes all entities. RCL_RET_WAIT_SET_INVALID, here and below, for one that is not initialized. */
rcl_ret_t rcl_wait_set_clear(rcl_wait_set_t * wait_set);

/* Removes all entities and changes the sizes; errors as for rcl_wait_set_init. */
rcl_ret_t rcl_wait_set_resize(
  rcl_wait_set_t * wait_set, size_t subscriptions_size, size_t guard_conditions_size, size_t timers_size,
  size_t clients_size, size_t services_size, size_t events_size);

/* Each returns the position in its array, unless `index` is NULL. RCL_RET_WAIT_SET_FULL. */
rcl_ret_t rcl_wait_set_add_subscription(
  rcl_wait_set_t * wait_set, const rcl_subscription_t * subscription, size_t * index);

rcl_ret_t rcl_wait_set_add_guard_condition(
  rcl_wait_set_t * wait_set, const rcl_guard_condition_t * guard_condition, size_t * index);

/*
 * Waits until an entity is ready. `timeout` in nanoseconds: 0 does not wait, negative waits without a
 * time-out. Runs the session meanwhile, and rests while no work is due. RCL_RET_TIMEOUT: nothing is ready;
 * RCL_RET_WAIT_SET_EMPTY: the set has room for no entity.
 */
rcl_ret_t rcl_wait(rcl_wait_set_t * wait_set, int64_t timeout);

bool rcl_wait_set_is_valid(const rcl_wait_set_t * wait_set);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAIT_H */
