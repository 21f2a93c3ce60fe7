/* SPDX-License-Identifier: Apache-2.0 */
/* Statistics of services and clients: an addition of this client to rmw_microros. */
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
  uint32_t dropped; /* requests that the agent sent unrequested and that had no room */
  uint32_t refused; /* requests larger than a slot of the queue, or not of the type */
} rmw_uros_service_statistics_t;

/* Counters since the client was opened. */
typedef struct rmw_uros_client_statistics_t {
  uint32_t dropped;     /* replies that the agent sent unrequested and that had no room */
  uint32_t refused;     /* replies that are too large, not of the type, or without an outstanding request */
  uint32_t given_up;    /* unanswered requests that were replaced by newer ones */
  uint32_t interrupted; /* requests that were outstanding when a session was lost */
} rmw_uros_client_statistics_t;

/* `service` is the result of rcl_service_get_rmw_handle; RMW_RET_INVALID_ARGUMENT. */
rmw_ret_t rmw_uros_get_service_statistics(
  const rmw_service_t * service, rmw_uros_service_statistics_t * statistics);

/* `client` is the result of rcl_client_get_rmw_handle; RMW_RET_INVALID_ARGUMENT. */
rmw_ret_t rmw_uros_get_client_statistics(
  const rmw_client_t * client, rmw_uros_client_statistics_t * statistics);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SERVICE_H */
