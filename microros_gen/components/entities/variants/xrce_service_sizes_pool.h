/* SPDX-License-Identifier: Apache-2.0 */
/* Sizes of the names of services, which the application passes: they are counted. Internal. */
#ifndef MICROROS_XRCE_SERVICE_SIZES_H
#define MICROROS_XRCE_SERVICE_SIZES_H

#include <stddef.h>
#include <stdint.h>

#include "microros/text.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes without the NUL; `type` is the service's own, without that of a message. */
typedef struct xrce_service_sizes_t {
  size_t name;
  size_t type;
} xrce_service_sizes_t;

/* Returns the sizes for the place of a service or client, which is open. */
static inline xrce_service_sizes_t xrce_service_sizes_of(const xrce_client_t * client, uint16_t place)
{
  const xrce_service_sizes_t sizes = {
    microros_text_size(client->endpoints[place - MICROROS_NODES_MAX].name),
    microros_text_size(client->services[place - XRCE_REPLIERS_AT].type->dds_type_name)};

  return sizes;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERVICE_SIZES_H */
