/* SPDX-License-Identifier: Apache-2.0 */
/* Seconds and nanoseconds of QoS policies. */
#ifndef MICROROS_RMW_TIME_H
#define MICROROS_RMW_TIME_H

#include <stdint.h>

#include "rcutils/time.h"
#include "rmw/macros.h"
#include "rmw/visibility_control.h"

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

#endif /* MICROROS_RMW_TIME_H */
