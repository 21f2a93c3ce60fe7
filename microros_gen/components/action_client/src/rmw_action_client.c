/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_action_client.h"

#include "microros/lock.h"
#include "microros/rmw_receiver.h"
#include "microros/xrce_action_client.h"
#include "microros/xrce_action_client_drops.h"
#include "microros/xrce_client.h"
#include "microros/xrce_read.h"
#include "microros/xrce_write_room.h"

#include <stddef.h>
#include <string.h>

bool rmw_action_client_may_send(const rmw_client_t * client)
{
  return xrce_write_has_room(client->data);
}

uint32_t rmw_action_client_drops(const rmw_client_t * client)
{
  const xrce_endpoint_t * endpoint = client->data;
  uint32_t result;

  microros_lock();
  result = xrce_action_client_drops(endpoint->client);
  microros_unlock();
  return result;
}

bool rmw_action_client_expects(const rmw_client_t * client, int64_t sequence_number)
{
  bool result;

  microros_lock();
  result = xrce_action_client_expects(client->data, sequence_number);
  microros_unlock();
  return result;
}

void rmw_action_client_abandon(const rmw_client_t * client, int64_t sequence_number)
{
  microros_lock();
  xrce_action_client_abandon(client->data, sequence_number);
  microros_unlock();
}

bool rmw_action_client_peek(const rmw_subscription_t * subscription, uint8_t * beginning, uint16_t size)
{
  xrce_sample_t sample;
  bool found;

  microros_lock();
  found = xrce_read_peek(subscription->data, &sample) && sample.size >= size;
  if (found) {
    (void)memcpy(beginning, sample.data, size);
  }
  microros_unlock();
  return found;
}

rmw_ret_t rmw_action_client_drop(const rmw_subscription_t * subscription)
{
  rmw_ret_t result = RMW_RET_ERROR;

  microros_lock();
  if (!rmw_receiver_report(subscription->data)) { /* it may be ready without a sample, for its report alone */
    xrce_read_pop(subscription->data, false);
    result = RMW_RET_OK;
  }
  microros_unlock();
  return result;
}
