/* SPDX-License-Identifier: Apache-2.0 */
/* Services and clients seen from the application: an addition of this client to rmw_microros. */
#ifndef MICROROS_RMW_MICROROS_SERVICE_H
#define MICROROS_RMW_MICROROS_SERVICE_H

#include <stdint.h>

#include "rmw/ret_types.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Counters since the service was opened. */
typedef struct rmw_uros_service_statistics_t {
  uint32_t dropped; /* requests that the agent sent beyond what it was asked for, and had no room */
  uint32_t refused; /* requests larger than a slot of the queue, or that were no message of the type */
} rmw_uros_service_statistics_t;

/* Counters since the client was opened. */
typedef struct rmw_uros_client_statistics_t {
  uint32_t dropped;     /* replies that the agent sent beyond what it was asked for, and had no room */
  uint32_t refused;     /* replies too large, or no message of the type, or that nobody waits for */
  uint32_t given_up;    /* requests without a reply that made room for newer ones */
  uint32_t interrupted; /* requests that were under way when a session was lost */
} rmw_uros_client_statistics_t;

/* `service` is of rcl_service_get_rmw_handle; RMW_RET_INVALID_ARGUMENT. */
rmw_ret_t rmw_uros_get_service_statistics(
  const rmw_service_t * service, rmw_uros_service_statistics_t * statistics);

/* `client` is of rcl_client_get_rmw_handle; RMW_RET_INVALID_ARGUMENT. */
rmw_ret_t rmw_uros_get_client_statistics(
  const rmw_client_t * client, rmw_uros_client_statistics_t * statistics);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SERVICE_H */
