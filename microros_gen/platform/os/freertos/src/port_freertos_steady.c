/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_freertos.h"

static const uint64_t ns_per_s = 1000000000;

int64_t port_time_steady_ns(void)
{
  const uint64_t hz = (uint64_t)configTICK_RATE_HZ;
  const uint64_t ticks = port_freertos_now();

  return (int64_t)(ticks / hz * ns_per_s + ticks % hz * ns_per_s / hz);
}
