/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/port_zephyr.h"

uint32_t port_time_ms(void)
{
  return k_uptime_get_32();
}

/* A board whose timer counts cycles in 64 bits has their resolution, another one that of the kernel's ticks. */
int64_t port_time_steady_ns(void)
{
#ifdef CONFIG_TIMER_HAS_64BIT_CYCLE_COUNTER
  return (int64_t)k_cyc_to_ns_floor64(k_cycle_get_64());
#else
  return (int64_t)k_ticks_to_ns_floor64((uint64_t)k_uptime_ticks());
#endif
}

/* The end is counted from now, so that being woken does not make the sleep longer. Without a duration it yields. */
void port_sleep_ms(uint32_t duration_ms)
{
  const int64_t end = k_uptime_ticks() + (int64_t)k_ms_to_ticks_ceil64(duration_ms) + 1;

  if (duration_ms == 0u) {
    k_yield();
    return;
  }
  while (k_uptime_ticks() < end) {
    (void)k_sleep(K_TIMEOUT_ABS_TICKS(end)); /* another thread may wake this one */
  }
}
