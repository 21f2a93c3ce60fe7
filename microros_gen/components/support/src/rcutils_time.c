/* SPDX-License-Identifier: Apache-2.0 */
#include "rcutils/time.h"

#include "microros/epoch.h"
#include "microros/error.h"
#include "microros/port.h"
#include "uxr/client/util/time.h"

rcutils_ret_t rcutils_system_time_now(rcutils_time_point_value_t * now)
{
  if (now == NULL) {
    return (rcutils_ret_t)microros_error_refuse(RCUTILS_RET_INVALID_ARGUMENT, "now");
  }
  *now = microros_epoch_ns();
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_steady_time_now(rcutils_time_point_value_t * now)
{
  if (now == NULL) {
    return (rcutils_ret_t)microros_error_refuse(RCUTILS_RET_INVALID_ARGUMENT, "now");
  }
  *now = port_time_steady_ns();
  return RCUTILS_RET_OK;
}

int64_t uxr_nanos(void)
{
  return microros_epoch_ns();
}

int64_t uxr_millis(void)
{
  return uxr_nanos() / 1000000;
}
