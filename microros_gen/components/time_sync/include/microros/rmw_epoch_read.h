/* SPDX-License-Identifier: Apache-2.0 */
/* The time of day by the newest answer of the agent. A component with a better one replaces this header. Internal. */
#ifndef MICROROS_RMW_EPOCH_READ_H
#define MICROROS_RMW_EPOCH_READ_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/xrce_client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes nanoseconds since 1970, or since the start of the device as long as it is not known: then returns false. */
static inline bool rmw_epoch_read(const xrce_client_t * client, int64_t * epoch_ns)
{
  *epoch_ns = port_time_steady_ns() + client->time_sync.offset_ns;
  return client->time_sync.synchronized;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_EPOCH_READ_H */
