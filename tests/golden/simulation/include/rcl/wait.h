/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wait sets, for who takes messages and calls timers without an executor. Several tasks may each have their own; one of
 * them owns the session.
 */
#ifndef MICROROS_RCL_WAIT_H
#define MICROROS_RCL_WAIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcl/subscription.h"
#include "rcl/timer.h"
#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/guard_condition.h"
#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Not selected: sources may have one, and nothing takes it. */
typedef struct rcl_client_s {
  void * impl;
} rcl_client_t;

/* Not selected: sources may have one, and nothing takes it. */
typedef struct rcl_service_s {
  void * impl;
} rcl_service_t;

typedef struct rcl_event_s rcl_event_t; /* XRCE has none */

typedef struct rcl_wait_set_impl_s rcl_wait_set_impl_t;

/* After rcl_wait what is not ready is NULL. */
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
  rcl_wait_set_impl_t * impl; /* the library's; NULL: not initialized */
} rcl_wait_set_t;

rcl_wait_set_t rcl_get_zero_initialized_wait_set(void);

/*
 * Takes one of `pools: {wait_sets: N}`. Of each kind it has room for as many entities as the application has at most: more
 * are RCL_RET_BAD_ALLOC, as is a pool that is empty. RCL_RET_ALREADY_INIT, RCL_RET_NOT_INIT for a context that is not
 * valid. `allocator` is not used.
 */
rcl_ret_t rcl_wait_set_init(
  rcl_wait_set_t * wait_set, size_t number_of_subscriptions, size_t number_of_guard_conditions,
  size_t number_of_timers, size_t number_of_clients, size_t number_of_services, size_t number_of_events,
  rcl_context_t * context, rcl_allocator_t allocator);

/* RCL_RET_OK for one that is not initialized, too. */
rcl_ret_t rcl_wait_set_fini(rcl_wait_set_t * wait_set);

rcl_ret_t rcl_wait_set_get_allocator(const rcl_wait_set_t * wait_set, rcl_allocator_t * allocator);

/* Makes it empty. RCL_RET_WAIT_SET_INVALID, here and below, for one that is not initialized. */
rcl_ret_t rcl_wait_set_clear(rcl_wait_set_t * wait_set);

/* Makes it empty, and gives it other sizes, as rcl_wait_set_init. */
rcl_ret_t rcl_wait_set_resize(
  rcl_wait_set_t * wait_set, size_t subscriptions_size, size_t guard_conditions_size, size_t timers_size,
  size_t clients_size, size_t services_size, size_t events_size);

/* Each of these gives the place in its array, unless `index` is NULL. RCL_RET_WAIT_SET_FULL. */
rcl_ret_t rcl_wait_set_add_subscription(
  rcl_wait_set_t * wait_set, const rcl_subscription_t * subscription, size_t * index);

rcl_ret_t rcl_wait_set_add_guard_condition(
  rcl_wait_set_t * wait_set, const rcl_guard_condition_t * guard_condition, size_t * index);

rcl_ret_t rcl_wait_set_add_timer(
  rcl_wait_set_t * wait_set, const rcl_timer_t * timer, size_t * index);

/*
 * Waits until something is ready; `timeout` in nanoseconds: 0 does not wait, negative waits for ever. Carries the session
 * on meanwhile, and rests while there is nothing to do. RCL_RET_TIMEOUT: nothing is ready; RCL_RET_WAIT_SET_EMPTY: it has
 * room for nothing.
 */
rcl_ret_t rcl_wait(rcl_wait_set_t * wait_set, int64_t timeout);

bool rcl_wait_set_is_valid(const rcl_wait_set_t * wait_set);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_WAIT_H */
