/* SPDX-License-Identifier: Apache-2.0 */
/* GET_INFO and its answer: asked by the application, and when nothing was heard for a while, to find a lost
 * session. */
#ifndef MICROROS_XRCE_PING_H
#define MICROROS_XRCE_PING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct xrce_ping_t {
  uint32_t due_ms;    /* when to ask again */
  uint8_t unanswered; /* questions since the agent was heard last */
  uint8_t answers;    /* INFOs and sessions granted: whoever waits for an agent sees that it changes */
} xrce_ping_t;

/* A session was granted. */
void xrce_ping_reset(xrce_ping_t * ping);

/* Asks once, in the session or, where there is none, outside of it. The session is not closed. */
void xrce_ping_ask(xrce_client_t * client);

/* Asks when MICROROS_LIVELINESS_PERIOD_MS went by in silence; after MICROROS_LIVELINESS_ATTEMPTS without an answer
 * within MICROROS_LIVELINESS_WAIT_MS the session is lost. */
void xrce_ping_step(xrce_client_t * client, uint32_t now);

/* An answer that says "not in a session" loses it, too: the agent has started anew. One that comes while the session is
 * looked for brings the next CREATE_CLIENT forward. */
void xrce_ping_on_info(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PING_H */
