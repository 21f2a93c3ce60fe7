/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_receiver.h"

#include "microros/lock.h"
#include "microros/rmw_node.h"
#include "microros/xrce_client.h"
#include "microros/xrce_place.h"
#include "microros/xrce_read.h"

#include <stddef.h>

static uint16_t receiver_place(const xrce_endpoint_t * endpoint)
{
  return (uint16_t)(MICROROS_NODES_MAX + endpoint->index);
}

rmw_ret_t rmw_receiver_start(const xrce_endpoint_t * wanted)
{
  xrce_endpoint_t * place = &wanted->client->endpoints[wanted->index];

  *place = *wanted;
  if (!xrce_place_is_kept(place->client, receiver_place(place))) {
    xrce_read_open(place);
  }
  return rmw_place_open(place->client, receiver_place(place), place->name);
}

rmw_ret_t rmw_receiver_open(
  xrce_endpoint_t * wanted, const rmw_section_t * section, const rmw_name_t * name, const char * given,
  xrce_endpoint_t ** endpoint)
{
  rmw_ret_t result = RMW_RET_ERROR;

  microros_lock();
  if (rmw_receiver_take(wanted, section, name, given)) {
    *endpoint = &wanted->client->endpoints[wanted->index];
    result = rmw_receiver_start(wanted);
  }
  microros_unlock();
  return result;
}

void rmw_receiver_close(const xrce_endpoint_t * endpoint)
{
  microros_lock();
  rmw_place_close(endpoint->client, receiver_place(endpoint));
  microros_unlock();
}

bool rmw_receiver_report(const xrce_endpoint_t * endpoint)
{
  uint16_t fits;
  const uint16_t large = xrce_read_large(endpoint, &fits);
  uint8_t status = 0;

  if (large != 0u) {
    microros_error_set(
      microros_error_sample_large, endpoint->name, endpoint->type->dds_type_name, large, fits);
    return true;
  }
  status = xrce_read_status(endpoint);
  if (status != 0u) {
    microros_error_set(microros_error_read_refused, endpoint->name, NULL, status, 0);
    return true;
  }
  return false;
}
