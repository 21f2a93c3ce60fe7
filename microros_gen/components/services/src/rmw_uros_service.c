/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_service.h"
#include "rmw_microros/service.h"

#include <stddef.h>

rmw_ret_t rmw_uros_get_service_statistics(
  const rmw_service_t * service, rmw_uros_service_statistics_t * statistics)
{
  xrce_read_counters_t counted;

  if (!rmw_replier_is_open(service) || statistics == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "service or statistics");
  }
  microros_lock();
  counted = xrce_read_counters(service->data);
  statistics->dropped = counted.dropped;
  statistics->refused = counted.refused;
  microros_unlock();
  return RMW_RET_OK;
}
