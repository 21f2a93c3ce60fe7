/* SPDX-License-Identifier: Apache-2.0 */
/* The time of day for stamps and functions of the system's time: the device's. A component with a better one replaces this
 * header, so nothing else above the port reads port_time_epoch_ns. Internal. */
#ifndef MICROROS_EPOCH_H
#define MICROROS_EPOCH_H

#include "microros/port.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns nanoseconds since 1970; 0: the time of day has not been set yet. */
static inline int64_t microros_epoch_known_ns(void)
{
  return port_time_epoch_ns();
}

/* Returns nanoseconds since 1970, or since the start of the device as long as the time of day is not known. */
static inline int64_t microros_epoch_ns(void)
{
  const int64_t epoch_ns = microros_epoch_known_ns();

  return epoch_ns != 0 ? epoch_ns : port_time_steady_ns();
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_EPOCH_H */
