/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The clock of another agent is another clock: a client whose time is synchronized asks each new agent for
 * its time. Until the answer, the time of the previous agent goes on.
 */
#ifndef MICROROS_XRCE_AGENTS_TIME_H
#define MICROROS_XRCE_AGENTS_TIME_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Zero-initialized: nothing is asked. */
typedef struct xrce_agents_time_t {
  uint32_t changes;  /* client->agents.changes of the last session */
  uint32_t since_ms; /* start of asking */
  uint32_t due_ms;   /* when to ask again */
  uint8_t replies;   /* client->time_sync.replies before asking */
  bool asks;
} xrce_agents_time_t;

/* Called when a session was granted. */
void xrce_agents_time_restart(xrce_client_t * client, uint32_t now);

/* Asks when it is due, until an answer has arrived. */
void xrce_agents_time_step(xrce_client_t * client, uint32_t now);

/* Returns the time until a question is due, at most `left`. */
uint32_t xrce_agents_time_left(const xrce_client_t * client, uint32_t left, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_AGENTS_TIME_H */
