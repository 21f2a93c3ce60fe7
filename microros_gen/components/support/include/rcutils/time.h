/* SPDX-License-Identifier: Apache-2.0 */
/* Times are signed nanoseconds. */
#ifndef MICROROS_RCUTILS_TIME_H
#define MICROROS_RCUTILS_TIME_H

#include <stdint.h>

#include "rcutils/macros.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_S_TO_NS(seconds) ((seconds) * (1000LL * 1000LL * 1000LL))
#define RCUTILS_MS_TO_NS(milliseconds) ((milliseconds) * (1000LL * 1000LL))
#define RCUTILS_US_TO_NS(microseconds) ((microseconds)*1000LL)
#define RCUTILS_NS_TO_S(nanoseconds) ((nanoseconds) / (1000LL * 1000LL * 1000LL))
#define RCUTILS_NS_TO_MS(nanoseconds) ((nanoseconds) / (1000LL * 1000LL))
#define RCUTILS_NS_TO_US(nanoseconds) ((nanoseconds) / 1000LL)

/* The clock for the macros RCUTILS_LOG_*_THROTTLE. */
#define RCUTILS_STEADY_TIME rcutils_steady_time_now

typedef int64_t rcutils_time_point_value_t;
typedef int64_t rcutils_duration_value_t;

/* Writes the time since 1970-01-01 00:00 UTC; since the start of the device until the time of day is set. Returns
 * RCUTILS_RET_INVALID_ARGUMENT, with a text, if `now` is NULL. For one task; docs/howto/port.md,
 * "Time that does not wrap". */
rcutils_ret_t rcutils_system_time_now(rcutils_time_point_value_t * now);

/* Writes the time since an arbitrary start; monotonic. Otherwise as above. */
rcutils_ret_t rcutils_steady_time_now(rcutils_time_point_value_t * now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_TIME_H */
