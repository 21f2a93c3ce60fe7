/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_objects.h"
#include "rcl/client.h"

#include <stddef.h>

const rcl_client_options_t * rcl_client_get_options(const rcl_client_t * client)
{
  static rcl_client_options_t options[MICROROS_CLIENTS_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rcl_client_options_t * own;

  if (!rcl_client_is_valid(client)) {
    (void)microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
    return NULL;
  }
  endpoint = client->impl->data;
  own = &options[MICROROS_NODES_MAX + endpoint->index - XRCE_REQUESTERS_AT];
  own->allocator = rcl_get_default_allocator();
  rmw_qos_actual(endpoint, &own->qos);
  return own;
}
