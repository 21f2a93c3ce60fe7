/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sizes of the names of services: those of the plan, so that a description copies names without looking for their end.
 * Internal. */
#ifndef MICROROS_XRCE_SERVICE_SIZES_H
#define MICROROS_XRCE_SERVICE_SIZES_H

#include <stdint.h>

#include "microros/flash.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

#if MICROROS_SERVICE_TEXT_MAX > 255u
typedef uint16_t xrce_service_size_t;
#else
typedef uint8_t xrce_service_size_t;
#endif

/* Bytes without the NUL; `type` is the service's own, without that of a message. */
typedef struct xrce_service_sizes_t {
  xrce_service_size_t name;
  xrce_service_size_t type;
} xrce_service_sizes_t;

extern const MICROROS_FLASH xrce_service_sizes_t xrce_service_sizes[XRCE_SERVICES];

/* Returns the sizes for the place of a service or client. */
static inline xrce_service_sizes_t xrce_service_sizes_of(const xrce_client_t * client, uint16_t place)
{
  (void)client;
  return xrce_service_sizes[place - XRCE_REPLIERS_AT];
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERVICE_SIZES_H */
