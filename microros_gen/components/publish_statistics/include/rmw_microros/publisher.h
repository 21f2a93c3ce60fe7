/* SPDX-License-Identifier: Apache-2.0 */
/* Statistics of a publisher: an addition of this client to rmw_microros. */
#ifndef MICROROS_RMW_MICROROS_PUBLISHER_H
#define MICROROS_RMW_MICROROS_PUBLISHER_H

#include <stdint.h>

#include "rmw/ret_types.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Messages since the publisher was opened, across lost sessions and sleep; wraps to 0 after 2^32 - 1.
 * `dropped` of rmw_uros_get_statistics is the total of all publishers. */
typedef struct rmw_uros_publisher_statistics_t {
  uint32_t dropped; /* no room, no session, refused by the transport, or replaced by newer ones */
} rmw_uros_publisher_statistics_t;

/* `publisher` is the result of rcl_publisher_get_rmw_handle; RMW_RET_INVALID_ARGUMENT. */
rmw_ret_t rmw_uros_get_publisher_statistics(
  const rmw_publisher_t * publisher, rmw_uros_publisher_statistics_t * statistics);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_PUBLISHER_H */
