/* SPDX-License-Identifier: Apache-2.0 */
/* Counts samples that arrive, for components that compare the number before and after a message. Internal. */
#ifndef MICROROS_XRCE_ARRIVALS_H
#define MICROROS_XRCE_ARRIVALS_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Returns a number that a sample raises by one when it arrives for this receiver. A best-effort sample may
 * replace older ones, which are then dropped; a reliable one that is dropped has not arrived.
 */
static inline uint32_t xrce_arrivals(const xrce_client_t * client, uint16_t index)
{
  const xrce_receiver_t * receiver = &client->receivers[index];
  const bool reliable = (client->endpoints[MICROROS_PUBLISHERS_MAX + index].qos & XRCE_QOS_RELIABLE) != 0u;

  return receiver->count + (reliable ? 0u : receiver->dropped);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ARRIVALS_H */
