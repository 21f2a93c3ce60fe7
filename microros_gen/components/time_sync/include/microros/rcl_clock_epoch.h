/* SPDX-License-Identifier: Apache-2.0 */
/* Where the time of day is from: the agent, else the device. In place of the file of the clock. Internal. */
#ifndef MICROROS_RCL_CLOCK_EPOCH_H
#define MICROROS_RCL_CLOCK_EPOCH_H

#include "microros/port.h"
#include "microros/rmw_epoch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns nanoseconds since 1970; 0: nobody has set the time of day yet. */
static inline int64_t rcl_clock_epoch_ns(void)
{
  int64_t epoch_ns = 0;

  return rmw_epoch_now(&epoch_ns) ? epoch_ns : port_time_epoch_ns();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_EPOCH_H */
