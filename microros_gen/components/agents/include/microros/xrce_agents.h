/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Several agents: when the session is lost, the client connects to the next one, and each is tried in turn
 * for MICROROS_AGENT_TRY_MS. After each round, the last agent of the round is tried for as long as the
 * search has taken so far, at most MICROROS_RETRY_MOST_MS: a client without an agent sends less and less.
 */
#ifndef MICROROS_XRCE_AGENTS_H
#define MICROROS_XRCE_AGENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum xrce_agents_state_t {
  XRCE_AGENTS_NEW,     /* of a session that was just opened */
  XRCE_AGENTS_OTHER,   /* the application set an address that is not in the list: it is used alone */
  XRCE_AGENTS_TRYING,  /* `index` is tried until `due_ms` */
  XRCE_AGENTS_SETTLED, /* the session is with `index` */
} xrce_agents_state_t;

/* Zero-initialized: the session was just opened. */
typedef struct xrce_agents_t {
  uint32_t since_ms; /* start of the search */
  uint32_t due_ms;   /* when to try the next agent */
  uint32_t changes;  /* sessions with another agent than the one before; wraps to 0 after 2^32 - 1 */
  uint8_t state;     /* xrce_agents_state_t */
  uint8_t index;     /* of the agent */
  uint8_t tried;     /* agents of this round, the current one included */
  uint8_t used;      /* 1 + index of the last agent that granted a session; 0: none did */
} xrce_agents_t;

/* Chooses the agent to connect to. Returns true. */
bool xrce_agents_step(xrce_client_t * client, uint32_t now);

/* Lets waiting functions return when the next agent is due. */
void xrce_agents_limit(xrce_client_t * client);

/* Called when an agent granted a session. */
void xrce_agents_connected(xrce_client_t * client);

/*
 * Handles a STATUS. An agent that is stopped sends the answer to a DELETE of the client that nobody asked for: the
 * session continues with the next agent at once. */
void xrce_agents_on_status(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Writes an agent of the list, `index` below MICROROS_AGENTS, to a transport that is not open. */
void xrce_agents_set(xrce_transport_t * transport, uint8_t index);

/* Returns the place of a transport's agent in the list; MICROROS_AGENTS: it is not there. */
uint8_t xrce_agents_find(const xrce_transport_t * transport);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_AGENTS_H */
