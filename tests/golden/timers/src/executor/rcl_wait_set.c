/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_wait_events.h"
#include "microros/rcl_wait_set.h"

#include <string.h>

rcl_wait_set_t rcl_get_zero_initialized_wait_set(void)
{
  rcl_wait_set_t wait_set;

  (void)memset(&wait_set, 0, sizeof(wait_set));
  return wait_set;
}

bool rcl_wait_set_is_valid(const rcl_wait_set_t * wait_set)
{
  return wait_set != NULL && wait_set->impl != NULL;
}

static rcl_ret_t set_check(const rcl_wait_set_t * wait_set)
{
  if (wait_set == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "wait_set");
  }
  return wait_set->impl != NULL ? RCL_RET_OK : microros_error_refuse(RCL_RET_WAIT_SET_INVALID, "wait_set");
}

static rcl_wait_set_impl_t * set_take(void)
{
  static rcl_wait_set_impl_t places[MICROROS_WAIT_SETS_MAX];

  for (size_t i = 0; i < MICROROS_WAIT_SETS_MAX; ++i) {
    if (!places[i].taken) {
      places[i].taken = true;
      return &places[i];
    }
  }
  microros_error_set(
    microros_error_of_pool(microros_error_pool_full, MICROROS_WAIT_SETS_MAX), "wait_sets", NULL,
    MICROROS_WAIT_SETS_MAX, MICROROS_WAIT_SETS_MAX + 1u);
  return NULL;
}

static bool set_fits(const char * what, size_t requested, size_t most)
{
  if (requested <= most) {
    return true;
  }
  microros_error_set(
    microros_error_of_pool(microros_error_pool_full, (uint32_t)requested - 1u), what, NULL, (uint32_t)most,
    (uint32_t)requested);
  return false;
}

rcl_ret_t rcl_wait_set_clear(rcl_wait_set_t * wait_set)
{
  const rcl_ret_t result = set_check(wait_set);

  if (result != RCL_RET_OK) {
    return result;
  }
  (void)memset(wait_set->impl->timers, 0, sizeof(wait_set->impl->timers));
  wait_set->impl->timer_count = 0;
  rcl_wait_events_clear(wait_set);
  return RCL_RET_OK;
}

rcl_ret_t rcl_wait_set_resize(
  rcl_wait_set_t * wait_set, size_t subscriptions_size, size_t guard_conditions_size, size_t timers_size,
  size_t clients_size, size_t services_size, size_t events_size)
{
  const rcl_ret_t result = rcl_wait_set_clear(wait_set);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (
    !set_fits("subscriptions", subscriptions_size, 0) ||
    !set_fits("guard_conditions", guard_conditions_size, 0) ||
    !set_fits("timers", timers_size, MICROROS_TIMERS_MAX) ||
    !set_fits("clients", clients_size, 0) ||
    !set_fits("services", services_size, 0) ||
    !set_fits("events", events_size, RCL_WAIT_EVENTS_MAX)) {
    return RCL_RET_BAD_ALLOC;
  }
  wait_set->timers = timers_size != 0u ? wait_set->impl->timers : NULL;
  wait_set->size_of_timers = timers_size;
  rcl_wait_events_resize(wait_set, events_size);
  return RCL_RET_OK;
}

rcl_ret_t rcl_wait_set_init(
  rcl_wait_set_t * wait_set, size_t number_of_subscriptions, size_t number_of_guard_conditions,
  size_t number_of_timers, size_t number_of_clients, size_t number_of_services, size_t number_of_events,
  rcl_context_t * context, rcl_allocator_t allocator)
{
  rcl_ret_t result;

  (void)allocator;
  if (wait_set == NULL || context == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "wait_set or context");
  }
  if (wait_set->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_executor, "the wait set is initialized");
  }
  if (!rcl_context_is_valid(context)) {
    return microros_error_refuse(RCL_RET_NOT_INIT, "context");
  }
  *wait_set = rcl_get_zero_initialized_wait_set();
  microros_lock();
  wait_set->impl = set_take();
  microros_unlock();
  if (wait_set->impl == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  result = rcl_wait_set_resize(
    wait_set, number_of_subscriptions, number_of_guard_conditions, number_of_timers, number_of_clients,
    number_of_services, number_of_events);
  if (result != RCL_RET_OK) {
    (void)rcl_wait_set_fini(wait_set); /* cannot fail: it is valid */
  }
  return result;
}

rcl_ret_t rcl_wait_set_fini(rcl_wait_set_t * wait_set)
{
  if (wait_set == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "wait_set");
  }
  if (wait_set->impl != NULL) {
    microros_lock();
    wait_set->impl->taken = false;
    microros_unlock();
    *wait_set = rcl_get_zero_initialized_wait_set();
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_wait_set_get_allocator(const rcl_wait_set_t * wait_set, rcl_allocator_t * allocator)
{
  const rcl_ret_t result = set_check(wait_set);

  if (result != RCL_RET_OK) {
    return result;
  }
  if (allocator == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "allocator");
  }
  *allocator = rcl_get_default_allocator();
  return RCL_RET_OK;
}

rcl_ret_t rcl_wait_set_add_timer(
  rcl_wait_set_t * wait_set, const rcl_timer_t * timer, size_t * index)
{
  const rcl_ret_t result = set_check(wait_set);
  size_t place;

  if (result != RCL_RET_OK) {
    return result;
  }
  if (timer == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "timer");
  }
  place = wait_set->impl->timer_count;
  if (place == wait_set->size_of_timers) {
    return microros_error_named(RCL_RET_WAIT_SET_FULL, microros_error_executor, "the wait set is full");
  }
  wait_set->timers[place] = timer;
  ++wait_set->impl->timer_count;
  if (index != NULL) {
    *index = place;
  }
  return RCL_RET_OK;
}
