/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"

#include "esp_timer.h"

static const int64_t ns_per_us = 1000;

/* A tick of the kernel is 10 ms by default; the timer counts microseconds. */
int64_t port_time_steady_ns(void)
{
  return esp_timer_get_time() * ns_per_us;
}
