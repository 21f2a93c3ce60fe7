/* SPDX-License-Identifier: Apache-2.0 */
#include "uxr/client/util/time.h"

#include "microros/port.h"

int64_t uxr_nanos(void)
{
  const int64_t epoch_ns = port_time_epoch_ns();

  return epoch_ns != 0 ? epoch_ns : port_time_steady_ns(); /* 0: the time of day has not been set yet */
}

int64_t uxr_millis(void)
{
  return uxr_nanos() / 1000000;
}
