/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_service.h"
#include "rmw_microros/service.h"

#include <stddef.h>

rmw_ret_t rmw_uros_get_client_statistics(
  const rmw_client_t * client, rmw_uros_client_statistics_t * statistics)
{
  const xrce_requester_t * requester;
  xrce_read_counters_t counted;

  if (!rmw_requester_is_open(client) || statistics == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "client or statistics");
  }
  microros_lock();
  counted = xrce_read_counters(client->data);
  statistics->dropped = counted.dropped;
  statistics->refused = counted.refused;
  requester = xrce_requests_of(client->data);
  statistics->given_up = requester->given_up;
  statistics->interrupted = requester->interrupted;
  microros_unlock();
  return RMW_RET_OK;
}
