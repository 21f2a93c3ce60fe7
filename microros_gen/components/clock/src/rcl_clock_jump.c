/* SPDX-License-Identifier: Apache-2.0 */
/* Jump callbacks: one pool for all clocks. */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_clock.h"
#include "microros_config.h"

#include <stddef.h>

typedef struct jump_entry_t {
  const rcl_clock_t * clock; /* NULL: free */
  rcl_jump_callback_info_t info;
} jump_entry_t;

static jump_entry_t jump_entries[MICROROS_JUMP_CALLBACKS_MAX];

/* Returns the entry of this clock with this callback; with clock NULL, any free one. */
static jump_entry_t * jump_find(
  const rcl_clock_t * clock, rcl_jump_callback_t callback, const void * user_data)
{
  for (size_t i = 0; i < MICROROS_JUMP_CALLBACKS_MAX; ++i) {
    jump_entry_t * entry = &jump_entries[i];

    if (
      entry->clock == clock &&
      (clock == NULL || (entry->info.callback == callback && entry->info.user_data == user_data))) {
      return entry;
    }
  }
  return NULL;
}

void rcl_clock_remove_callbacks(rcl_clock_t * clock)
{
  microros_lock();
  for (size_t i = 0; i < MICROROS_JUMP_CALLBACKS_MAX; ++i) {
    if (jump_entries[i].clock == clock) {
      jump_entries[i].clock = NULL;
    }
  }
  clock->num_jump_callbacks = 0;
  microros_unlock();
}

static bool jump_reaches(const rcl_time_jump_t * jump, const rcl_jump_threshold_t * threshold)
{
  const bool is_change =
    jump->clock_change == RCL_ROS_TIME_ACTIVATED || jump->clock_change == RCL_ROS_TIME_DEACTIVATED;
  const rcl_duration_value_t delta = jump->delta.nanoseconds;
  const rcl_duration_value_t backward = threshold->min_backward.nanoseconds;
  const rcl_duration_value_t forward = threshold->min_forward.nanoseconds;

  return (is_change && threshold->on_clock_change) || (backward < 0 && delta <= backward) ||
         (forward > 0 && delta >= forward);
}

void rcl_clock_call_callbacks(const rcl_clock_t * clock, const rcl_time_jump_t * jump, bool before_jump)
{
  for (size_t i = 0; i < MICROROS_JUMP_CALLBACKS_MAX; ++i) {
    const jump_entry_t * entry = &jump_entries[i];
    rcl_jump_callback_t callback = NULL;
    void * user_data = NULL;

    microros_lock();
    if (entry->clock == clock && jump_reaches(jump, &entry->info.threshold)) {
      callback = entry->info.callback;
      user_data = entry->info.user_data;
    }
    microros_unlock();
    if (callback != NULL) {
      callback(jump, before_jump, user_data);
    }
  }
}

static rcl_ret_t jump_add(
  rcl_clock_t * clock, const rcl_jump_threshold_t * threshold, rcl_jump_callback_t callback, void * user_data)
{
  jump_entry_t * entry;

  if (jump_find(clock, callback, user_data) != NULL) {
    return rcl_clock_refuse(RCL_RET_ERROR, "it has this jump callback");
  }
  entry = jump_find(NULL, NULL, NULL);
  if (entry == NULL) {
    microros_error_set(
      microros_error_of_pool(microros_error_pool_full, MICROROS_JUMP_CALLBACKS_MAX), "jump_callbacks", NULL,
      MICROROS_JUMP_CALLBACKS_MAX, MICROROS_JUMP_CALLBACKS_MAX + 1u);
    return RCL_RET_BAD_ALLOC;
  }
  entry->clock = clock;
  entry->info.callback = callback;
  entry->info.threshold = *threshold;
  entry->info.user_data = user_data;
  ++clock->num_jump_callbacks;
  return RCL_RET_OK;
}

rcl_ret_t rcl_clock_add_jump_callback(
  rcl_clock_t * clock, rcl_jump_threshold_t threshold, rcl_jump_callback_t callback, void * user_data)
{
  rcl_ret_t result;

  if (
    clock == NULL || callback == NULL || threshold.min_forward.nanoseconds < 0 ||
    threshold.min_backward.nanoseconds > 0) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "clock, callback or threshold");
  }
  microros_lock();
  result = jump_add(clock, &threshold, callback, user_data);
  microros_unlock();
  return result;
}

rcl_ret_t rcl_clock_remove_jump_callback(rcl_clock_t * clock, rcl_jump_callback_t callback, void * user_data)
{
  jump_entry_t * entry;

  if (clock == NULL || callback == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "clock or callback");
  }
  microros_lock();
  entry = jump_find(clock, callback, user_data);
  if (entry != NULL) {
    entry->clock = NULL;
    --clock->num_jump_callbacks;
  }
  microros_unlock();
  return entry != NULL ? RCL_RET_OK : rcl_clock_refuse(RCL_RET_ERROR, "it has no such jump callback");
}
