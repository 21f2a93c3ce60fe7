/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_objects.h"
#include "rcl/publisher.h"

#include <stddef.h>

const rmw_qos_profile_t * rcl_publisher_get_actual_qos(const rcl_publisher_t * publisher)
{
  static rmw_qos_profile_t profiles[MICROROS_PUBLISHERS_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rmw_qos_profile_t * profile;

  if (!rcl_publisher_is_valid(publisher)) {
    (void)microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
    return NULL;
  }
  endpoint = publisher->impl->data;
  profile = &profiles[endpoint->index];
  rmw_qos_actual(endpoint, profile);
  return profile;
}

const rcl_publisher_options_t * rcl_publisher_get_options(const rcl_publisher_t * publisher)
{
  static rcl_publisher_options_t options[MICROROS_PUBLISHERS_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rcl_publisher_options_t * own;

  if (!rcl_publisher_is_valid(publisher)) {
    (void)microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
    return NULL;
  }
  endpoint = publisher->impl->data;
  own = &options[endpoint->index];
  own->allocator = rcl_get_default_allocator();
  rmw_qos_actual(endpoint, &own->qos);
  return own;
}
