/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"

#include <stddef.h>
#include <sys/time.h>

static const int64_t ns_per_s = 1000000000;
static const int64_t ns_per_us = 1000;
static const int64_t seconds_of_2000 = 946684800; /* 2000-01-01 00:00 UTC */

/* The time of day of the C library, which SNTP or settimeofday sets. Without that it counts from 1970, and is 0 here. */
int64_t port_time_epoch_ns(void)
{
  struct timeval now;

  if (gettimeofday(&now, NULL) != 0 || (int64_t)now.tv_sec < seconds_of_2000) {
    return 0;
  }
  return (int64_t)now.tv_sec * ns_per_s + (int64_t)now.tv_usec * ns_per_us;
}
