/* SPDX-License-Identifier: Apache-2.0 */
/* Time under the names of the public XRCE client. */
#ifndef MICROROS_UXR_CLIENT_UTIL_TIME_H
#define MICROROS_UXR_CLIENT_UTIL_TIME_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Milliseconds and nanoseconds since 1970-01-01 00:00 UTC; since the start of the device until the time of
 * day is set. For one task; docs/howto/port.md, "Time that does not wrap". */
int64_t uxr_millis(void);
int64_t uxr_nanos(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_UXR_CLIENT_UTIL_TIME_H */
