/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw/time.h"

#define NS_PER_S 1000000000u

rmw_duration_t rmw_time_total_nsec(const rmw_time_t time)
{
  const uint64_t most = (uint64_t)INT64_MAX;
  uint64_t total;

  if (time.sec > most / NS_PER_S || time.nsec > most - time.sec * NS_PER_S) {
    return INT64_MAX;
  }
  total = time.sec * NS_PER_S + time.nsec;
  return (rmw_duration_t)total;
}

rmw_time_t rmw_time_from_nsec(const rmw_duration_t nanoseconds)
{
  rmw_time_t time = RMW_DURATION_INFINITE;

  if (nanoseconds >= 0) {
    const uint64_t left = (uint64_t)nanoseconds;

    time.sec = left / NS_PER_S;
    time.nsec = left % NS_PER_S;
  }
  return time;
}

rmw_time_t rmw_time_normalize(const rmw_time_t time)
{
  return rmw_time_from_nsec(rmw_time_total_nsec(time));
}

bool rmw_time_equal(const rmw_time_t left, const rmw_time_t right)
{
  return rmw_time_total_nsec(left) == rmw_time_total_nsec(right);
}
