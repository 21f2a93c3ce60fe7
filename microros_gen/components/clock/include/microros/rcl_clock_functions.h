/* SPDX-License-Identifier: Apache-2.0 */
/* Functions of clocks, for rcl/time.h, which includes this file. No function blocks; allocators are stored
 * and never called. Any task may call them for a clock that is initialized; jump callbacks run in the task that sets the
 * time, or that receives it, without the lock. */
#ifndef MICROROS_RCL_CLOCK_FUNCTIONS_H
#define MICROROS_RCL_CLOCK_FUNCTIONS_H

#include <stdbool.h>

#include "rcl/time.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the clock's time is above 0; false for a ROS clock that waits for its first time. */
bool rcl_clock_time_started(rcl_clock_t * clock);

bool rcl_clock_valid(rcl_clock_t * clock);

/* Calls one of the three below; RCL_CLOCK_UNINITIALIZED makes a clock without a time. */
rcl_ret_t rcl_clock_init(rcl_clock_type_t clock_type, rcl_clock_t * clock, rcl_allocator_t * allocator);

/* RCL_RET_INVALID_ARGUMENT for a clock that is not initialized. */
rcl_ret_t rcl_clock_fini(rcl_clock_t * clock);

/*
 * ROS time: the system's time until it is overridden. With `clock: ros` it is the time of /clock, which
 * the library subscribes to with the first node; 0 until the first sample. The override is then enabled
 * from the start; while it is disabled, the clock returns the system's time. The time advances when the
 * client receives: in the executor, rcl_wait, rcl_take or rcl_publish. Uses one of MICROROS_ROS_CLOCKS_MAX
 * places (`pools: {ros_clocks: N}`; with `clock: ros` rclc_support_init uses one for `support.clock`);
 * RCL_RET_BAD_ALLOC if all are in use.
 */
rcl_ret_t rcl_ros_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator);

/* RCL_RET_ERROR, here and below, for a clock of another type. */
rcl_ret_t rcl_ros_clock_fini(rcl_clock_t * clock);

/*
 * Monotonic time since an arbitrary start; in steps of a millisecond on a board without an operating
 * system. */
rcl_ret_t rcl_steady_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator);

rcl_ret_t rcl_steady_clock_fini(rcl_clock_t * clock);

/*
 * Time since 1970-01-01 00:00 UTC: the agent's after rmw_uros_sync_session; time since the start if the
 * time of day was never set. */
rcl_ret_t rcl_system_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator);

rcl_ret_t rcl_system_clock_fini(rcl_clock_t * clock);

/* Computes finish - start; RCL_RET_ERROR for times of different types. */
rcl_ret_t rcl_difference_times(
  const rcl_time_point_t * start, const rcl_time_point_t * finish, rcl_duration_t * delta);

/* RCL_RET_ERROR for a clock that is not initialized. */
rcl_ret_t rcl_clock_get_now(rcl_clock_t * clock, rcl_time_point_value_t * time_point_value);

/* From now on this ROS clock returns the time that was set, which stands still between calls. Jump
 * callbacks are called, and timers continue in the new time: as in Jazzy, the elapsed share of their
 * period becomes the share that was left. */
rcl_ret_t rcl_enable_ros_time_override(rcl_clock_t * clock);

rcl_ret_t rcl_disable_ros_time_override(rcl_clock_t * clock);

rcl_ret_t rcl_is_enabled_ros_time_override(rcl_clock_t * clock, bool * is_enabled);

/* Sets the time; jump callbacks are called and timers updated if the override is enabled. */
rcl_ret_t rcl_set_ros_time_override(rcl_clock_t * clock, rcl_time_point_value_t time_value);

/*
 * Calls `callback` before and after each jump that reaches the threshold; a threshold of 0 is never
 * reached. Uses one of MICROROS_JUMP_CALLBACKS_MAX places for all clocks (`pools: {jump_callbacks: N}`);
 * RCL_RET_BAD_ALLOC if all are in use, RCL_RET_ERROR for a pair of callback and user data that is already
 * registered. num_jump_callbacks counts them; jump_callbacks is not used.
 */
rcl_ret_t rcl_clock_add_jump_callback(
  rcl_clock_t * clock, rcl_jump_threshold_t threshold, rcl_jump_callback_t callback, void * user_data);

/* RCL_RET_ERROR if no such pair is registered. Another task that sets the time may just be calling it. */
rcl_ret_t rcl_clock_remove_jump_callback(rcl_clock_t * clock, rcl_jump_callback_t callback, void * user_data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_FUNCTIONS_H */
