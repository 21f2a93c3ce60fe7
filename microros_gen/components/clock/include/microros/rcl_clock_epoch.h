/* SPDX-License-Identifier: Apache-2.0 */
/* Where the time of day is from: the device. A component that knows better brings another file of this name. Internal. */
#ifndef MICROROS_RCL_CLOCK_EPOCH_H
#define MICROROS_RCL_CLOCK_EPOCH_H

#include "microros/port.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns nanoseconds since 1970; 0: nobody has set the time of day yet. */
static inline int64_t rcl_clock_epoch_ns(void)
{
  return port_time_epoch_ns();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_EPOCH_H */
