/* SPDX-License-Identifier: Apache-2.0 */
/* What the session and the executor call of this component, in the functions that component.yaml names. Internal. */
#ifndef MICROROS_RCL_DIAGNOSTICS_H
#define MICROROS_RCL_DIAGNOSTICS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"
#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Notes that the period is over: the executor publishes, because a step must not send by itself. */
static inline void xrce_diagnostics_step(xrce_client_t * client, uint32_t now)
{
  if (client->diagnostics.running && (int32_t)(now - client->diagnostics.due_ms) >= 0) {
    client->diagnostics.due_ms = now + MICROROS_DIAGNOSTICS_PERIOD_MS;
    client->diagnostics.is_due = true;
  }
}

/* Returns how long the client can be left alone: `left`, or until the counters are published. */
static inline uint32_t xrce_diagnostics_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  return client->diagnostics.running ? xrce_sooner(left, client->diagnostics.due_ms, now) : left;
}

/* Opens the publisher with the first node, which has its declaration. RCL_RET_OK for other nodes. */
rcl_ret_t rcl_diagnostics_open(rcl_node_t * node);

/* Closes the publisher where it is this node's. */
void rcl_diagnostics_close(rcl_node_t * node);

/* Publishes the counters where the period is over. */
void rcl_diagnostics_publish(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_DIAGNOSTICS_H */
