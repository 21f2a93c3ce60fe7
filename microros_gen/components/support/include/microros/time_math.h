/* SPDX-License-Identifier: Apache-2.0 */
/* Times of 64 bits in nanoseconds, near the ends of what they can say. Internal. */
#ifndef MICROROS_TIME_MATH_H
#define MICROROS_TIME_MATH_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns `time + duration`, INT64_MAX at most; `duration` is not negative. */
int64_t microros_time_after(int64_t time, int64_t duration);

/* Returns `later - earlier`, within INT64_MIN and INT64_MAX, whichever of them is later. */
int64_t microros_time_between(int64_t earlier, int64_t later);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_TIME_MATH_H */
