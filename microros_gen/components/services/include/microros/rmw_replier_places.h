/* SPDX-License-Identifier: Apache-2.0 */
/* The handles of service servers by place. For this component and `by_place` only. */
#ifndef MICROROS_RMW_REPLIER_PLACES_H
#define MICROROS_RMW_REPLIER_PLACES_H

#include "microros/rmw_client.h"
#include "microros/xrce_objects.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern rmw_service_t rmw_repliers[MICROROS_SERVICES_MAX];

/* Returns the handle of an open place. */
static inline rmw_service_t * rmw_replier_prepare(xrce_endpoint_t * endpoint)
{
  rmw_service_t * service = &rmw_repliers[MICROROS_NODES_MAX + endpoint->index - XRCE_REPLIERS_AT];

  service->implementation_identifier = rmw_implementation_identifier;
  service->data = endpoint;
  service->service_name = endpoint->name;
  return service;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_REPLIER_PLACES_H */
