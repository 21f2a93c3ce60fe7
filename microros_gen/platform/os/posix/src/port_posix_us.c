/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_diagnosis.h"

#include <time.h>

uint32_t port_time_us(void)
{
  const uint64_t us_per_s = 1000000;
  struct timespec now = {0, 0};

  (void)clock_gettime(CLOCK_MONOTONIC, &now); /* cannot fail with this clock */
  return (uint32_t)(((uint64_t)now.tv_sec * us_per_s + (uint64_t)now.tv_nsec / 1000u) & UINT32_MAX);
}
