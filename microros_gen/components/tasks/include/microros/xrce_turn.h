/* SPDX-License-Identifier: Apache-2.0 */
/* While the task of the session runs, it alone receives and sends; others store messages, and ask it to send them. The
 * caller holds the lock of the library. Replaces the header of component `session`. Internal. */
#ifndef MICROROS_XRCE_TURN_H
#define MICROROS_XRCE_TURN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_transport.h"
#include "microros/xrce_turn_room.h"
#include "microros/xrce_turn_send.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { XRCE_TURN_POLL_MS = 1000 };

/* Messages that a pump receives, with the lock. The task of the session receives with xrce_session_spin. */
enum { XRCE_TURN_MESSAGES = 1 };

/* The smallest payload of what an agent sends, but for the end of a sample in fragments, which is alone in its message. A
 * submessage with it takes so many bytes up to the next one. */
enum { XRCE_TURN_SHORTEST = 5, XRCE_TURN_SHORTEST_PLACE = 12 };

/* Returns whether a submessage with so many bytes of payload is taken after another one of its message: this bounds the work
 * for a message, and with it the hold of the lock. */
static inline bool xrce_turn_takes(size_t length)
{
  return length >= (size_t)XRCE_TURN_SHORTEST;
}

/* Returns whether the calling task may receive and send: the task of the session, and each task while that does not run. */
bool xrce_turn_is_mine(void);

/* The same; if it is another task's turn, the time of the session is now, for what the caller stores. */
bool xrce_turn_begin(xrce_client_t * client);

/* Asks the task of the session to receive and send, and ends its wait. */
void xrce_turn_request(const xrce_client_t * client);

/* Between these two the calling task may send, without giving up the lock: a message outside of all streams, for which
 * nothing else waits. Then the task of the session has it written, if the transport has not. */
void xrce_turn_borrow(void);
void xrce_turn_return(const xrce_client_t * client);

/* Called when another task may have given the session something to do that no message shows. In a round of an executor, its
 * end asks the session instead. */
void xrce_turn_change(const xrce_client_t * client);

/* Called after something was stored that the task of the session hands to a stream, also by that task itself. */
static inline void xrce_turn_stored(const xrce_client_t * client)
{
  xrce_turn_request(client);
}

/* The calling task begins and ends a round of its executor. */
void xrce_turn_set_round(bool is_in_round);

/* Returns the longest wait for the line, milliseconds. While the task of the session runs, all that concerns it ends its
 * wait. */
uint32_t xrce_turn_longest_ms(const xrce_client_t * client);

/* Returns whether the task of the session runs. */
bool xrce_turn_is_taken(void);

/* Hook: a message is about to be stored. */
void xrce_turn_commit(const xrce_client_t * client);

/* The calling task, that of the session, begins or ends to be the one that receives and sends. */
void xrce_turn_take(void);
void xrce_turn_leave(void);

/* Called before the task of the session receives and sends: it has seen what it was asked for. */
void xrce_turn_see(void);

/* Returns whether it was asked since. */
bool xrce_turn_is_requested(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TURN_H */
