/* SPDX-License-Identifier: Apache-2.0 */
/* What the library asks of a computer: PlatformIO's platform `native`, on Linux and macOS. */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <errno.h>
#include <time.h>
#include <unistd.h>

static int64_t clock_ns(clockid_t clock)
{
  struct timespec now = {0, 0};

  (void)clock_gettime(clock, &now); /* cannot fail with these clocks */
  return (int64_t)now.tv_sec * 1000000000 + (int64_t)now.tv_nsec;
}

uint32_t port_time_ms(void)
{
  return (uint32_t)((uint64_t)clock_ns(CLOCK_MONOTONIC) / 1000000u);
}

int64_t port_time_steady_ns(void)
{
  return clock_ns(CLOCK_MONOTONIC);
}

int64_t port_time_epoch_ns(void)
{
  return clock_ns(CLOCK_REALTIME);
}

void port_sleep_ms(uint32_t duration_ms)
{
  struct timespec left = {(time_t)(duration_ms / 1000u), (long)(duration_ms % 1000u) * 1000000L};

  while (nanosleep(&left, &left) != 0 && errno == EINTR) {
    /* `left` is what remains */
  }
}

/* The library waits in the transport's read function. */
void port_wake(void)
{
}

/* Differs from program to program. */
uint32_t port_unique_id(void)
{
  static uint32_t id;

  if (id == 0u) {
    const uint64_t now = (uint64_t)clock_ns(CLOCK_REALTIME);

    id = ((uint32_t)getpid() * 2654435761u) ^ (uint32_t)now ^ (uint32_t)(now >> 32);
    id = id == 0u ? 1u : id;
  }
  return id;
}
