/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The time of day: that of the source, otherwise the agent's. Replaces the header of component `time_sync`.
 * Internal. */
#ifndef MICROROS_RMW_EPOCH_READ_H
#define MICROROS_RMW_EPOCH_READ_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_time_filter.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes nanoseconds since 1970, or since the start of the device as long as it is not known: then returns false. */
static inline bool rmw_epoch_read(const xrce_client_t * client, int64_t * epoch_ns)
{
  const int64_t now_ns = port_time_steady_ns();

  if (client->time_source.filter.is_set) {
    *epoch_ns = xrce_time_served(&client->time_source.filter, now_ns);
    return true;
  }
  *epoch_ns = now_ns + client->time_sync.offset_ns;
  return client->time_sync.synchronized;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_EPOCH_READ_H */
