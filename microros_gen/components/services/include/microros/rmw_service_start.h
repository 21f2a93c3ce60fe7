/* SPDX-License-Identifier: Apache-2.0 */
/* The last step of opening a service or client, by its name or by its place: an image mostly has one of the two. Internal. */
#ifndef MICROROS_RMW_SERVICE_START_H
#define MICROROS_RMW_SERVICE_START_H

#include "microros/error.h"
#include "microros/rmw_receiver.h"
#include "microros/rmw_service.h"
#include "microros/xrce_client.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_services.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

static inline bool rmw_service_fits(const microros_message_type_t * sent, bool replies)
{
  const size_t capacity = xrce_route_capacity(true) - (replies ? XRCE_IDENTITY_SIZE : 0u);

  if (sent->max_encoded_size <= capacity) {
    return true;
  }
  microros_error_set(
    microros_error_service_small, sent->dds_type_name, NULL, sent->max_encoded_size, (uint32_t)capacity);
  return false;
}

/* Fills in the place of `wanted` and waits for its object. */
static inline rmw_ret_t rmw_service_start(const xrce_endpoint_t * wanted, const xrce_service_t * service)
{
  xrce_service_t * place = xrce_service_of(wanted);

  place->type = service->type;
  place->sent = rmw_service_sent(wanted->index, service->sent);
  return rmw_service_fits(place->sent, MICROROS_NODES_MAX + wanted->index < XRCE_REQUESTERS_AT)
           ? rmw_receiver_start(wanted)
           : RMW_RET_ERROR;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_SERVICE_START_H */
