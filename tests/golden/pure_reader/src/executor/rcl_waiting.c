/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_waiting.h"

#include "microros/port.h"
#include "microros/rmw_client_wait.h"

static const int64_t waiting_ns_per_ms = 1000000;

/* Rounded up; UINT32_MAX for what is longer, and for what is negative. */
static uint32_t waiting_ms(int64_t duration_ns)
{
  const int64_t longest_ns = (int64_t)(UINT32_MAX - 1u) * waiting_ns_per_ms;

  if (duration_ns < 0 || duration_ns > longest_ns) {
    return UINT32_MAX;
  }
  return (uint32_t)((duration_ns + waiting_ns_per_ms - 1) / waiting_ns_per_ms);
}

rcl_waiting_t rcl_waiting_begin(int64_t timeout_ns)
{
  const rcl_waiting_t waiting = {port_time_ms(), waiting_ms(timeout_ns)};

  return waiting;
}

void rcl_waiting_receive(void)
{
  rmw_client_pump();
}

bool rcl_waiting_is_over(const rcl_waiting_t * waiting)
{
  return waiting->timeout_ms != UINT32_MAX && port_time_ms() - waiting->start_ms >= waiting->timeout_ms;
}

void rcl_waiting_rest(const rcl_waiting_t * waiting, int64_t look_again_ns)
{
  const uint32_t passed_ms = port_time_ms() - waiting->start_ms;
  uint32_t rest_ms = waiting_ms(look_again_ns);

  if (waiting->timeout_ms != UINT32_MAX) {
    const uint32_t left_ms = passed_ms < waiting->timeout_ms ? waiting->timeout_ms - passed_ms : 0u;

    rest_ms = left_ms < rest_ms ? left_ms : rest_ms;
  }
  if (rest_ms != 0u) {
    rmw_client_wait(rest_ms);
  }
}
