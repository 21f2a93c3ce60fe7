/* SPDX-License-Identifier: Apache-2.0 */
/* What the session, nodes and executors call. Internal. */
#ifndef MICROROS_RCL_DIAGNOSIS_HOOKS_H
#define MICROROS_RCL_DIAGNOSIS_HOOKS_H

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"
#include "rcl/node.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Opens the publisher with the first node. Waits for the agent; the codes are those of rcl_publisher_init. */
rcl_ret_t rcl_diagnosis_open(const rcl_node_t * node);

/* Closes it with its node. Values of checks stay. */
void rcl_diagnosis_close(const rcl_node_t * node);

/* Returns whether the publisher is open; after a sleep that is when the node has been opened again. */
bool rcl_diagnosis_is_running(const xrce_client_t * client);

/* Called in each pump: measures once in a period, and sends as far as the stream has room. */
void rcl_diagnosis_step(xrce_client_t * client, uint32_t now);

/* Requests the modes of checks with an error; called in the task of the executor. */
void rcl_diagnosis_request(void);

/* Called before and after the executor waits, and around the callbacks of a round. */
void rcl_diagnosis_rests(void);
void rcl_diagnosis_rested(void);
void rcl_diagnosis_round_begins(void);
void rcl_diagnosis_round_ends(void);

/* Returns how long the client can be left alone: `left`, or until the end of the period. */
static inline uint32_t rcl_diagnosis_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  return rcl_diagnosis_is_running(client) ? xrce_sooner(left, client->diagnosis.due_ms, now) : left;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_DIAGNOSIS_HOOKS_H */
