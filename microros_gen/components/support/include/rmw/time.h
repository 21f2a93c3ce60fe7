/* SPDX-License-Identifier: Apache-2.0 */
/* Seconds and nanoseconds of QoS policies. */
#ifndef MICROROS_RMW_TIME_H
#define MICROROS_RMW_TIME_H

#include <stdbool.h>
#include <stdint.h>

#include "rcutils/time.h"
#include "rmw/macros.h"
#include "rmw/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_time_s {
  uint64_t sec;
  uint64_t nsec;
} rmw_time_t;

typedef rcutils_time_point_value_t rmw_time_point_value_t;
typedef rcutils_duration_value_t rmw_duration_t;

/* clang-format off */
#define RMW_DURATION_INFINITE {9223372036LL, 854775807LL}
#define RMW_DURATION_UNSPECIFIED {0LL, 0LL}
/* clang-format on */

/* Returns whether both are the same time, in whatever representation. */
bool rmw_time_equal(const rmw_time_t left, const rmw_time_t right);

/* Returns nanoseconds; INT64_MAX, which is RMW_DURATION_INFINITE, for longer times. */
rmw_duration_t rmw_time_total_nsec(const rmw_time_t time);

/* Returns RMW_DURATION_INFINITE for a negative number. */
rmw_time_t rmw_time_from_nsec(const rmw_duration_t nanoseconds);

/* Returns the same time with less than a second of nanoseconds. */
rmw_time_t rmw_time_normalize(const rmw_time_t time);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_TIME_H */
