/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The session with the agent: a state machine that never blocks. Not thread-safe; one task owns a client.
 *
 * closed -> connecting (CREATE_CLIENT, repeated with growing pauses) -> ready -> closing (if session_close
 * is selected: DELETE, answered by STATUS) -> closed. A lost session returns to connecting automatically.
 */
#ifndef MICROROS_XRCE_SESSION_H
#define MICROROS_XRCE_SESSION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_output_queue.h"
#include "microros/xrce_transport.h"
#include "microros/xrce_turn.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum xrce_state_t { XRCE_CLOSED, XRCE_CONNECTING, XRCE_READY, XRCE_CLOSING } xrce_state_t;

/* Each counter wraps to 0 after 2^32 - 1. */
typedef struct xrce_statistics_t {
  uint32_t sent;
  uint32_t resent;
  uint32_t received;
  uint32_t malformed;
  uint32_t dropped;
  uint32_t reconnects;
  uint32_t refused;
} xrce_statistics_t;

typedef struct xrce_session_t {
  xrce_transport_t transport;
  uint32_t key;
  uint32_t now_ms;      /* start of the last pump */
  uint32_t due_ms;      /* when to send the next CREATE_CLIENT */
  uint32_t received_ms; /* when the agent was last heard */
  uint32_t since_ms;    /* start of connecting */
  uint16_t request;     /* the next request id */
  uint8_t state;        /* xrce_state_t */
  uint8_t refusal;      /* status of the agent's refusal, or 0 */
  bool transport_open;
  bool was_ready;  /* the next session is a reconnection */
  bool in_session; /* the current message was received within a session */
  xrce_statistics_t statistics;
} xrce_session_t;

/* Starts connecting. Clears the whole client; set the agent's address in session.transport before the
 * first pump. */
void xrce_session_open(xrce_client_t * client, uint32_t key);

/*
 * Waits for the session for at most `timeout_ms`. On false, session.refusal says whether the agent
 * refused. */
bool xrce_session_await(xrce_client_t * client, uint32_t timeout_ms);

/* Closes the local side at once; call xrce_route_close first to close the session at the agent. */
void xrce_session_close(xrce_client_t * client);

/* Waits until the line has sent everything, for at most client->close_timeout_ms. Returns false if data
 * remains, or without a session. Only xrce_session_close may follow. */
bool xrce_session_drain(xrce_client_t * client);

/* Marks the session as lost and connects again. */
void xrce_session_mark_lost(xrce_client_t * client, uint32_t now);

/* Receives and runs all work that is due, or asks the task whose turn it is to do so (xrce_turn.h). Never blocks. */
void xrce_session_pump(xrce_client_t * client);

/* The same without receiving. */
void xrce_session_step_all(xrce_client_t * client);

/* Sends one whole message. Returns false if the transport refused it, or it is another task's turn. */
bool xrce_session_send(xrce_session_t * session, const uint8_t * message, size_t size);

/* Returns whether the line has sent everything. */
static inline bool xrce_session_is_sent(xrce_session_t * session)
{
  return !session->transport_open ||
         (xrce_output_queue_is_empty() && xrce_turn_is_sent() && xrce_transport_is_idle(&session->transport));
}

/*
 * Returns the pause before an unanswered request is repeated: `wanted_ms`, which should grow with the time
 * since the first request, limited to MICROROS_RETRY_FIRST_MS and MICROROS_RETRY_MOST_MS.
 */
uint32_t xrce_session_pause(uint32_t wanted_ms);

/* Same within a session, for a request that was first sent `waited_ms` ago: a quarter of that time. Only
 * datagrams are lost there, so the pauses grow slowly. */
static inline uint32_t xrce_session_short_pause(uint32_t waited_ms)
{
  return xrce_session_pause(waited_ms / 4u);
}

/* Returns a request id that no outstanding request uses. */
uint16_t xrce_session_next_request(xrce_session_t * session);

/* For xrce_routes.c and the input stream. The first dispatches the submessages of a whole message; it
 * returns false for a malformed message. */
bool xrce_session_take_submessages(
  xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now);
void xrce_session_step(xrce_client_t * client, uint32_t now);
void xrce_session_on_status_agent(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SESSION_H */
