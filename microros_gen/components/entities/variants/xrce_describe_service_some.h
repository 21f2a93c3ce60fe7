/* SPDX-License-Identifier: Apache-2.0 */
/* The description of a replier or requester. Internal. */
#ifndef MICROROS_XRCE_DESCRIBE_SERVICE_H
#define MICROROS_XRCE_DESCRIBE_SERVICE_H

#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Describes the replier or requester at a place, as xrce_describe does. */
uint8_t * xrce_describe_service(
  const xrce_client_t * client, uint16_t place, uint8_t * blob, uint8_t * format);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_DESCRIBE_SERVICE_H */
