/* SPDX-License-Identifier: Apache-2.0 */
/* Saturating arithmetic on 64-bit times in nanoseconds. Internal. */
#ifndef MICROROS_TIME_MATH_H
#define MICROROS_TIME_MATH_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns `time + duration`, at most INT64_MAX; `duration` is not negative. */
int64_t microros_time_after(int64_t time, int64_t duration);

/* Returns `later - earlier`, limited to INT64_MIN and INT64_MAX; either may be the later one. */
int64_t microros_time_between(int64_t earlier, int64_t later);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_TIME_MATH_H */
