/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/publisher.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_publisher.h"
#include "microros/xrce_client.h"

#include <stddef.h>

rmw_ret_t rmw_uros_get_publisher_statistics(
  const rmw_publisher_t * publisher, rmw_uros_publisher_statistics_t * statistics)
{
  const xrce_endpoint_t * writer;

  if (!rmw_publisher_is_open(publisher) || statistics == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "publisher or statistics");
  }
  writer = publisher->data;
  microros_lock();
  statistics->dropped = writer->client->dropped[writer->index];
  microros_unlock();
  return RMW_RET_OK;
}
