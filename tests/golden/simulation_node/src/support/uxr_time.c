/* SPDX-License-Identifier: Apache-2.0 */
#include "uxr/client/util/time.h"

#include "microros/port.h"

int64_t uxr_millis(void)
{
  return port_time_epoch_ns() / 1000000;
}

int64_t uxr_nanos(void)
{
  return port_time_epoch_ns();
}
