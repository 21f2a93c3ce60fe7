/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/rcl_clock.h"
#include "microros/rcl_clock_epoch.h"

rcl_ret_t rcl_clock_system_now(void * data, rcl_time_point_value_t * now)
{
  const int64_t epoch_ns = rcl_clock_epoch_ns();

  (void)data;
  *now = epoch_ns != 0 ? epoch_ns : port_time_steady_ns(); /* 0: the time of day has not been set yet */
  return RCL_RET_OK;
}

rcl_ret_t rcl_system_clock_init(rcl_clock_t * clock, rcl_allocator_t * allocator)
{
  return rcl_clock_begin(clock, RCL_SYSTEM_TIME, rcl_clock_system_now, allocator);
}

rcl_ret_t rcl_system_clock_fini(rcl_clock_t * clock)
{
  return rcl_clock_end(clock, RCL_SYSTEM_TIME);
}
