/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The session with the agent: a state machine that never blocks. Nothing here is thread-safe; one task owns a
 * client.
 *
 * closed -> connecting (CREATE_CLIENT, repeated with growing pauses) -> ready -> closing (where session_close is
 * selected: DELETE, answered by STATUS) -> closed. A session found lost goes back to connecting by itself.
 */
#ifndef MICROROS_XRCE_SESSION_H
#define MICROROS_XRCE_SESSION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_transport.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum xrce_state_t { XRCE_CLOSED, XRCE_CONNECTING, XRCE_READY, XRCE_CLOSING } xrce_state_t;

/* Each counter starts again at 0 after 2^32 - 1. */
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
  uint32_t now_ms;   /* when the last pump began */
  uint32_t due_ms;   /* when to send the next CREATE_CLIENT */
  uint32_t heard_ms; /* when the agent was heard last */
  uint32_t since_ms; /* since when the agent is looked for */
  uint16_t request;  /* the next request id */
  uint8_t state;     /* xrce_state_t */
  uint8_t refusal;   /* status that the agent refused the session with, or 0 */
  bool transport_open;
  bool was_ready;  /* the next session is a reconnection */
  bool in_session; /* the message that is being handled came within a session */
  xrce_statistics_t statistics;
} xrce_session_t;

/* Starts connecting. Clears everything that the client had; before the first pump, say in session.transport where
 * the agent is. */
void xrce_session_open(xrce_client_t * client, uint32_t key);

/* Waits at most `timeout_ms` for the session. False: session.refusal says whether the agent refused. */
bool xrce_session_await(xrce_client_t * client, uint32_t timeout_ms);

/* Closes at once, on this side alone; xrce_route_close takes leave of the agent before. */
void xrce_session_close(xrce_client_t * client);

/* Lets what was handed to the line leave it, what was written last too, for at most client->close_timeout_ms. False: some of
 * it is still there, or there was no session. Only xrce_session_close may follow. */
bool xrce_session_drain(xrce_client_t * client);

/* Gives the session up and connects again. */
void xrce_session_lose(xrce_client_t * client, uint32_t now);

/* Receives all that is there and does all that is due. Never blocks. */
void xrce_session_pump(xrce_client_t * client);

/* Does all that is due, without receiving. */
void xrce_session_step_all(xrce_client_t * client);

/* Sends one whole message. False: the transport did not take it. */
bool xrce_session_send(xrce_session_t * session, const uint8_t * message, size_t size);

/* Whether nothing of what was sent still waits for the line. */
static inline bool xrce_session_is_sent(xrce_session_t * session)
{
  return !session->transport_open || xrce_transport_is_idle(&session->transport);
}

/*
 * Returns how long to wait for an answer before the question is repeated: `wanted_ms`, which is to grow with the time that has
 * gone by since it was asked first, at least MICROROS_RETRY_FIRST_MS and at most MICROROS_RETRY_MOST_MS.
 */
uint32_t xrce_session_pause(uint32_t wanted_ms);

/* Returns the same within a session, for a question that was asked first `waited_ms` ago: a quarter of it. What is lost
 * there is a datagram, so the pauses grow slowly. */
static inline uint32_t xrce_session_short_pause(uint32_t waited_ms)
{
  return xrce_session_pause(waited_ms / 4u);
}

/* Returns a request id that no outstanding request has. */
uint16_t xrce_session_next_request(xrce_session_t * session);

/* What xrce_routes.c and the input stream call. The first hands on the submessages of a whole message; false where the
 * message is not what it should be. */
bool xrce_session_take_submessages(
  xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now);
void xrce_session_step(xrce_client_t * client, uint32_t now);
void xrce_session_on_status_agent(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SESSION_H */
