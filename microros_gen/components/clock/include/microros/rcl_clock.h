/* SPDX-License-Identifier: Apache-2.0 */
/* What the files of clocks share; internal. Pointers are not NULL. */
#ifndef MICROROS_RCL_CLOCK_H
#define MICROROS_RCL_CLOCK_H

#include <stdbool.h>

#include "rcl/time.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef rcl_ret_t (*rcl_clock_get_now_t)(void * data, rcl_time_point_value_t * now);

/* What `data` of a ROS clock is. */
typedef struct rcl_ros_time_t {
  rcl_time_point_value_t now; /* 0: not set */
  rcl_clock_t * clock;        /* whose it is; NULL: free */
  bool active;                /* `now` counts, and not the system's time */
} rcl_ros_time_t;

/* Makes an empty clock of this type; RCL_RET_INVALID_ARGUMENT, with a text, where clock or allocator is NULL. */
rcl_ret_t rcl_clock_begin(
  rcl_clock_t * clock, rcl_clock_type_t type, rcl_clock_get_now_t get_now, const rcl_allocator_t * allocator);

/* Ends a clock of this type and frees its jump callbacks; RCL_RET_ERROR for a clock of another one. */
rcl_ret_t rcl_clock_end(rcl_clock_t * clock, rcl_clock_type_t type);

/* Frees the jump callbacks of a clock. */
void rcl_clock_forget_callbacks(rcl_clock_t * clock);

/* Calls the jump callbacks whose threshold is reached. */
void rcl_clock_call_callbacks(const rcl_clock_t * clock, const rcl_time_jump_t * jump, bool before_jump);

/* Nanoseconds since 1970; on a board without the time of day those since its start. */
rcl_ret_t rcl_clock_system_now(void * data, rcl_time_point_value_t * now);

/* Sets all ROS clocks, as rcl_set_ros_time_override. */
void rcl_ros_clocks_set(rcl_time_point_value_t time_value);

/* Sets this text, "clock: " in front, and returns `result`. */
rcl_ret_t rcl_clock_refuse(rcl_ret_t result, const char * reason);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_H */
