/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_waiting.h"

#include "microros/port.h"
#include "microros/rmw_client_wait.h"

/* A millisecond is 15625 units of 64 ns: a divisor that leaves room for 16 more binary digits in 32 bits. */
static const int64_t waiting_ns_per_ms = 1000000;
static const uint32_t waiting_units_per_ms = 15625;

/*
 * Rounds up; UINT32_MAX for negative and too long durations. Long division with 16 binary digits at a
 * time: a 64-bit division would link a library function larger than all of waiting.
 */
static uint32_t waiting_ms(int64_t duration_ns)
{
  const int64_t longest_ns = (int64_t)(UINT32_MAX - 1u) * waiting_ns_per_ms;
  uint64_t units;
  uint32_t rest = 0;
  uint32_t whole_ms = 0;

  if (duration_ns == 0) {
    return 0; /* every round of a loop that does not wait */
  }
  if (duration_ns < 0 || duration_ns > longest_ns) {
    return UINT32_MAX;
  }
  units = (uint64_t)(duration_ns + waiting_ns_per_ms - 1) >> 6; /* below 2^48: three times 16 digits */
  for (uint32_t i = 0; i < 3u; ++i) {
    rest = rest << 16 | (uint16_t)(units >> 32);
    units <<= 16;
    whole_ms = whole_ms << 16 | rest / waiting_units_per_ms;
    rest %= waiting_units_per_ms;
  }
  return whole_ms;
}

rcl_waiting_t rcl_waiting_begin(int64_t timeout_ns)
{
  return rcl_waiting_of(port_time_ms(), waiting_ms(timeout_ns));
}

void rcl_waiting_receive(void)
{
  rmw_client_pump();
}

bool rcl_waiting_is_over(const rcl_waiting_t * waiting)
{
  return waiting->timeout_ms != UINT32_MAX && port_time_ms() - waiting->start_ms >= waiting->timeout_ms;
}

void rcl_waiting_rest(rcl_waiting_t * waiting, int64_t look_again_ns)
{
  const uint32_t passed_ms = port_time_ms() - waiting->start_ms;
  uint32_t rest_ms = waiting_ms(look_again_ns);

  if (waiting->timeout_ms != UINT32_MAX) {
    const uint32_t left_ms = passed_ms < waiting->timeout_ms ? waiting->timeout_ms - passed_ms : 0u;

    rest_ms = left_ms < rest_ms ? left_ms : rest_ms;
  }
  if (rest_ms != 0u) {
    rcl_waiting_sleep(waiting, rest_ms);
  }
}
