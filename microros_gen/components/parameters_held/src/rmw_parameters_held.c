/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_parameters_held.h"

#include "microros/lock.h"
#include "microros/xrce_client.h"
#include "microros/xrce_objects.h"

uint32_t rmw_parameters_board(const rmw_publisher_t * publisher)
{
  const xrce_endpoint_t * writer = publisher->data;
  uint32_t key;

  microros_lock();
  key = writer->client->session.key;
  microros_unlock();
  return key;
}

uint32_t rmw_parameters_reconnects(const rmw_publisher_t * publisher)
{
  const xrce_endpoint_t * writer = publisher->data;
  uint32_t count;

  microros_lock();
  count = writer->client->session.statistics.reconnects;
  microros_unlock();
  return count;
}
