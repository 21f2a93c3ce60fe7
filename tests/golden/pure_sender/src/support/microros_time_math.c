/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/time_math.h"

int64_t microros_time_after(int64_t time, int64_t duration)
{
  return time <= INT64_MAX - duration ? time + duration : INT64_MAX;
}

int64_t microros_time_between(int64_t earlier, int64_t later)
{
  if (earlier < 0) {
    return later <= INT64_MAX + earlier ? later - earlier : INT64_MAX;
  }
  return later >= INT64_MIN + earlier ? later - earlier : INT64_MIN;
}
