/* SPDX-License-Identifier: Apache-2.0 */
/* What a service was opened with. */
#include "microros/error.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_objects.h"
#include "rcl/service.h"

#include <stddef.h>

/* Both directions share one profile. */
const rmw_qos_profile_t * rcl_service_request_subscription_get_actual_qos(const rcl_service_t * service)
{
  static rmw_qos_profile_t profiles[MICROROS_SERVICES_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rmw_qos_profile_t * profile;

  if (!rcl_service_is_valid(service)) {
    (void)microros_error_refuse(RCL_RET_SERVICE_INVALID, "service");
    return NULL;
  }
  endpoint = service->impl->data;
  profile = &profiles[MICROROS_NODES_MAX + endpoint->index - XRCE_REPLIERS_AT];
  rmw_qos_actual(endpoint, profile);
  return profile;
}

const rmw_qos_profile_t * rcl_service_response_publisher_get_actual_qos(const rcl_service_t * service)
{
  return rcl_service_request_subscription_get_actual_qos(service);
}

const rcl_service_options_t * rcl_service_get_options(const rcl_service_t * service)
{
  static rcl_service_options_t options[MICROROS_SERVICES_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rcl_service_options_t * own;

  if (!rcl_service_is_valid(service)) {
    (void)microros_error_refuse(RCL_RET_SERVICE_INVALID, "service");
    return NULL;
  }
  endpoint = service->impl->data;
  own = &options[MICROROS_NODES_MAX + endpoint->index - XRCE_REPLIERS_AT];
  own->allocator = rcl_get_default_allocator();
  rmw_qos_actual(endpoint, &own->qos);
  return own;
}
