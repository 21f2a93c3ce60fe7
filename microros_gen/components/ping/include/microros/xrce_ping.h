/* SPDX-License-Identifier: Apache-2.0 */
/* GET_INFO and INFO: sent for the application, and after a period of silence to detect a lost session. */
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
  uint8_t unanswered; /* requests since the last message from the agent */
  uint8_t replies;    /* INFOs and granted sessions: a change shows that an agent answered */
} xrce_ping_t;

/* Called when a session was granted. */
void xrce_ping_reset(xrce_ping_t * ping);

/* Sends one request, inside the session if one is open. The session stays open. */
void xrce_ping_request(xrce_client_t * client);

/* Sends a request after MICROROS_LIVELINESS_PERIOD_MS of silence; the session is lost after
 * MICROROS_LIVELINESS_ATTEMPTS requests without an answer within MICROROS_LIVELINESS_WAIT_MS. */
void xrce_ping_step(xrce_client_t * client, uint32_t now);

/* An answer "not in a session" also loses the session: the agent has restarted. An answer while the
 * session reconnects triggers the next CREATE_CLIENT earlier. */
void xrce_ping_on_info(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PING_H */
