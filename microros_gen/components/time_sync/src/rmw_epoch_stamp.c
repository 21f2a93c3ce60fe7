/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/time_sync.h"

#include "microros/rmw_epoch.h"

#include <stddef.h>

static const int64_t stamp_ns_per_s = 1000000000;

bool rmw_uros_epoch_stamp(int32_t * sec, uint32_t * nanosec)
{
  int64_t epoch_ns = 0;
  const bool synchronized = rmw_epoch_now(&epoch_ns);
  const int64_t now_ns = synchronized ? epoch_ns : rmw_uros_epoch_nanos();
  const int64_t whole_s = now_ns / stamp_ns_per_s;

  if (sec == NULL || nanosec == NULL || now_ns <= 0 || whole_s > INT32_MAX) {
    return false;
  }
  *sec = (int32_t)whole_s;
  *nanosec = (uint32_t)(now_ns % stamp_ns_per_s);
  return synchronized;
}
