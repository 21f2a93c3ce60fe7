/* SPDX-License-Identifier: Apache-2.0 */
/* Managed publishers write while their node is active. Internal. */
#ifndef MICROROS_XRCE_GATE_H
#define MICROROS_XRCE_GATE_H

#include <stdbool.h>

#include "microros/xrce_client.h"

enum { XRCE_GATE_ACTIVE = 3 }; /* lifecycle_msgs/msg/State: PRIMARY_STATE_ACTIVE */

/* Whether each publisher is managed, from the plan. */
extern const bool xrce_gate_managed[MICROROS_PUBLISHERS_MAX];

/* Returns false for what is to be dropped and counted. A transition counts when it has ended. */
static inline bool xrce_gate_is_open(const xrce_endpoint_t * writer)
{
  return !xrce_gate_managed[writer->index] ||
         writer->client->lifecycle[writer->participant] == (uint8_t)XRCE_GATE_ACTIVE;
}

#endif /* MICROROS_XRCE_GATE_H */
