/* SPDX-License-Identifier: Apache-2.0 */
/* Shared by the source files of clocks; internal. Pointers are not NULL. */
#ifndef MICROROS_RCL_CLOCK_H
#define MICROROS_RCL_CLOCK_H

#include <stdbool.h>

#include "rcl/time.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef rcl_ret_t (*rcl_clock_get_now_t)(void * data, rcl_time_point_value_t * now);

/* Type of `data` of a ROS clock. */
typedef struct rcl_ros_time_t {
  rcl_time_point_value_t now; /* 0: not set */
  rcl_clock_t * clock;        /* the owner; NULL: free */
  bool active;                /* `now` is the time, instead of the system's */
} rcl_ros_time_t;

/*
 * Initializes an empty clock of this type. RCL_RET_INVALID_ARGUMENT, with a text, if clock or allocator is
 * NULL. */
rcl_ret_t rcl_clock_begin(
  rcl_clock_t * clock, rcl_clock_type_t type, rcl_clock_get_now_t get_now, const rcl_allocator_t * allocator);

/* Finalizes a clock of this type and frees its jump callbacks. RCL_RET_ERROR for a clock of another type. */
rcl_ret_t rcl_clock_end(rcl_clock_t * clock, rcl_clock_type_t type);

/* Frees the jump callbacks of a clock. */
void rcl_clock_remove_callbacks(rcl_clock_t * clock);

/* Calls the jump callbacks whose threshold is reached. */
void rcl_clock_call_callbacks(const rcl_clock_t * clock, const rcl_time_jump_t * jump, bool before_jump);

/* Nanoseconds since 1970; since the start on a board that does not know the time of day. */
rcl_ret_t rcl_clock_system_now(void * data, rcl_time_point_value_t * now);

/* Sets all ROS clocks, as rcl_set_ros_time_override does. */
void rcl_ros_clocks_set(rcl_time_point_value_t time_value);

/* Sets the error text "clock: " and `reason`; returns `result`. */
rcl_ret_t rcl_clock_refuse(rcl_ret_t result, const char * reason);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_H */
