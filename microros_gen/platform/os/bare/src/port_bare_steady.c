/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"

/* For one task. The milliseconds wrap to 0 after 49 days, so it must be called at least once in this time: the component
 * long_time does that. */
int64_t port_time_steady_ns(void)
{
  static const int64_t ns_per_ms = 1000000;
  static int64_t steady_ms;
  const uint32_t passed_ms = port_time_ms() - (uint32_t)((uint64_t)steady_ms & UINT32_MAX);

  steady_ms += (int64_t)passed_ms;
  return steady_ms * ns_per_ms;
}
