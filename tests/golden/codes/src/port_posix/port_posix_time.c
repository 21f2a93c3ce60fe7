/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <errno.h>
#include <time.h>

uint32_t port_time_ms(void)
{
  struct timespec now = {0, 0};

  (void)clock_gettime(CLOCK_MONOTONIC, &now); /* cannot fail with this clock */
  return (uint32_t)((uint64_t)now.tv_sec * 1000u + (uint64_t)now.tv_nsec / 1000000u);
}

int64_t port_time_epoch_ns(void)
{
  struct timespec now = {0, 0};

  (void)clock_gettime(CLOCK_REALTIME, &now);
  return (int64_t)now.tv_sec * 1000000000 + (int64_t)now.tv_nsec;
}

void port_sleep_ms(uint32_t duration_ms)
{
  struct timespec left = {(time_t)(duration_ms / 1000u), (long)(duration_ms % 1000u) * 1000000L};

  while (nanosleep(&left, &left) != 0 && errno == EINTR) {
    /* nanosleep has stored the remaining time in `left` */
  }
}
