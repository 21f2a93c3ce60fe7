/* SPDX-License-Identifier: Apache-2.0 */
/* What a client was opened with. */
#include "microros/error.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_objects.h"
#include "rcl/client.h"

#include <stddef.h>

/* Both directions share one profile. */
const rmw_qos_profile_t * rcl_client_request_publisher_get_actual_qos(const rcl_client_t * client)
{
  static rmw_qos_profile_t profiles[MICROROS_CLIENTS_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rmw_qos_profile_t * profile;

  if (!rcl_client_is_valid(client)) {
    (void)microros_error_refuse(RCL_RET_CLIENT_INVALID, "client");
    return NULL;
  }
  endpoint = client->impl->data;
  profile = &profiles[MICROROS_NODES_MAX + endpoint->index - XRCE_REQUESTERS_AT];
  rmw_qos_actual(endpoint, profile);
  return profile;
}

const rmw_qos_profile_t * rcl_client_response_subscription_get_actual_qos(const rcl_client_t * client)
{
  return rcl_client_request_publisher_get_actual_qos(client);
}

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
