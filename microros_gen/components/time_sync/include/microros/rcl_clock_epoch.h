/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Source of the time of day: the agent, otherwise the device. Replaces the header of component `clock`.
 * Internal. */
#ifndef MICROROS_RCL_CLOCK_EPOCH_H
#define MICROROS_RCL_CLOCK_EPOCH_H

#include "microros/port.h"
#include "microros/rmw_epoch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns nanoseconds since 1970; 0: the time of day has not been set yet. */
static inline int64_t rcl_clock_epoch_ns(void)
{
  int64_t epoch_ns = 0;

  return rmw_epoch_now(&epoch_ns) ? epoch_ns : port_time_epoch_ns();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_CLOCK_EPOCH_H */
