/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of clocks, for rcl/time.h, which includes this file. Nothing here waits, and allocators are kept and not
 * called. Clocks and timers belong to one task. */
#ifndef MICROROS_RCL_CLOCK_FUNCTIONS_H
#define MICROROS_RCL_CLOCK_FUNCTIONS_H

#include <stdbool.h>

#include "rcl/time.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether the clock says more than 0; a ROS clock that waits for its first time does not. */
bool rcl_clock_time_started(rcl_clock_t * clock);

bool rcl_clock_valid(rcl_clock_t * clock);

/* One of the three below; RCL_CLOCK_UNINITIALIZED makes a clock that has no time. */
rcl_ret_t rcl_clock_init(rcl_clock_type_t clock_type, rcl_clock_t * clock, rcl_allocator_t * allocator);

/* RCL_RET_INVALID_ARGUMENT for a clock that is not initialized. */
rcl_ret_t rcl_clock_fini(rcl_clock_t * clock);

/*
 * ROS time: the system's, until it is overridden. With `clock: ros` that of /clock, to which the library subscribes with the
 * first node; 0 until one has come. The override is then enabled from the start; while it is disabled, the clock says the
 * system's time, and time moves when the client receives: in the executor, rcl_wait, rcl_take or rcl_publish. Takes one of
 * MICROROS_ROS_CLOCKS_MAX places (`pools: {ros_clocks: N}`; with `clock: ros` rclc_support_init takes one for
 * `support.clock`), or RCL_RET_BAD_ALLOC.
 */
rcl_ret_t rcl_ros_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator);

/* RCL_RET_ERROR, here and below, for a clock of another type. */
rcl_ret_t rcl_ros_clock_fini(rcl_clock_t * clock);

/* Time since some start, which never goes back; on a board without an operating system in steps of a millisecond. */
rcl_ret_t rcl_steady_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator);

rcl_ret_t rcl_steady_clock_fini(rcl_clock_t * clock);

/* Time since 1970-01-01 00:00 UTC: the agent's after rmw_uros_sync_session; where nobody has set it, since the start. */
rcl_ret_t rcl_system_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator);

rcl_ret_t rcl_system_clock_fini(rcl_clock_t * clock);

/* Gives finish - start; RCL_RET_ERROR for times of two types. */
rcl_ret_t rcl_difference_times(
  const rcl_time_point_t * start, const rcl_time_point_t * finish, rcl_duration_t * delta);

/* RCL_RET_ERROR for a clock that is not initialized. */
rcl_ret_t rcl_clock_get_now(rcl_clock_t * clock, rcl_time_point_value_t * time_point_value);

/* The time of this ROS clock is now what was set, and stands still between. Jump callbacks learn of it, and timers go on in
 * the new time: as in Jazzy, as much of their period is over as was left of it. */
rcl_ret_t rcl_enable_ros_time_override(rcl_clock_t * clock);

rcl_ret_t rcl_disable_ros_time_override(rcl_clock_t * clock);

rcl_ret_t rcl_is_enabled_ros_time_override(rcl_clock_t * clock, bool * is_enabled);

/* Sets the time; jump callbacks and timers learn of it when the override is enabled. */
rcl_ret_t rcl_set_ros_time_override(rcl_clock_t * clock, rcl_time_point_value_t time_value);

/*
 * Calls `callback` before and after each jump that reaches the threshold; a threshold of 0 is never reached. Takes one of
 * MICROROS_JUMP_CALLBACKS_MAX places for all clocks (`pools: {jump_callbacks: N}`), or RCL_RET_BAD_ALLOC; RCL_RET_ERROR
 * for a pair of callback and user data that is there already. num_jump_callbacks counts them, jump_callbacks is not used.
 */
rcl_ret_t rcl_clock_add_jump_callback(
  rcl_clock_t * clock, rcl_jump_threshold_t threshold, rcl_jump_callback_t callback, void * user_data);

/* RCL_RET_ERROR when there is no such pair. */
rcl_ret_t rcl_clock_remove_jump_callback(rcl_clock_t * clock, rcl_jump_callback_t callback, void * user_data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_FUNCTIONS_H */
