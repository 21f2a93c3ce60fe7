/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/rcl_clock.h"

static rcl_ret_t clock_steady_now(void * data, rcl_time_point_value_t * now)
{
  (void)data;
  *now = port_time_steady_ns();
  return RCL_RET_OK;
}

rcl_ret_t rcl_steady_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator)
{
  return rcl_clock_begin(clock, RCL_STEADY_TIME, clock_steady_now, allocator);
}

rcl_ret_t rcl_steady_clock_fini(rcl_clock_t * clock)
{
  return rcl_clock_end(clock, RCL_STEADY_TIME);
}
