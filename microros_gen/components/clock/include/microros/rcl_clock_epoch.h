/* SPDX-License-Identifier: Apache-2.0 */
/* Source of the time of day: the device. A component with a better source replaces this header. Internal. */
#ifndef MICROROS_RCL_CLOCK_EPOCH_H
#define MICROROS_RCL_CLOCK_EPOCH_H

#include "microros/port.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns nanoseconds since 1970; 0: the time of day has not been set yet. */
static inline int64_t rcl_clock_epoch_ns(void)
{
  return port_time_epoch_ns();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_EPOCH_H */
