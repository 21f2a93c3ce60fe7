/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How the session is, told as it changes: an addition of this client to rmw_microros. Nothing has to be done in answer:
 * the session finds back and creates its entities again by itself.
 */
#ifndef MICROROS_RMW_MICROROS_SESSION_STATE_H
#define MICROROS_RMW_MICROROS_SESSION_STATE_H

#include <stdint.h>

#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* CONNECTING, CONNECTED; then LOST, RECONNECTING, CONNECTED as often as the agent goes; CLOSED. */
typedef enum rmw_uros_session_state_t {
  RMW_UROS_SESSION_CLOSED,      /* by rcl_shutdown */
  RMW_UROS_SESSION_CONNECTING,  /* rcl_init looks for the agent */
  RMW_UROS_SESSION_CONNECTED,   /* there is a session; after a loss: and all entities are back */
  RMW_UROS_SESSION_LOST,        /* the agent is looked for from now on */
  RMW_UROS_SESSION_RECONNECTING /* the agent is there, entities are created again */
} rmw_uros_session_state_t;

/* Why a session is lost. */
typedef enum rmw_uros_session_reason_t {
  RMW_UROS_REASON_NONE,
  RMW_UROS_REASON_SILENT,         /* the agent does not answer (liveliness: ping) */
  RMW_UROS_REASON_FORGOTTEN,      /* the agent says that it has no such session: it has started anew */
  RMW_UROS_REASON_UNACKNOWLEDGED, /* reliable data stays unacknowledged (liveliness: acknack) */
  RMW_UROS_REASON_BROKEN,         /* the connection broke off (TCP) */
  RMW_UROS_REASON_REFUSED         /* a new one, after another reason; the agent is asked again */
} rmw_uros_session_reason_t;

/* Counters since rcl_init, as in rmw_uros_statistics_t. */
typedef struct rmw_uros_session_event_t {
  rmw_uros_session_state_t state;
  rmw_uros_session_reason_t reason; /* of LOST, else NONE */
  uint32_t losses;                  /* sessions lost */
  uint32_t reconnects;              /* sessions opened after one was lost */
  uint32_t dropped;                 /* messages that could not be sent or kept */
} rmw_uros_session_event_t;

/* `event` lives until it returns. It must return soon and call no function that is given an entity or a context. */
typedef void (*rmw_uros_session_callback_t)(const rmw_uros_session_event_t * event, void * argument);

/*
 * Sets who is told from now on; NULL: nobody. It may be set before rcl_init, and stays over rcl_shutdown. It is called
 * from within the functions of this library, by the task that calls them: whatever publishes, takes, spins or waits.
 * `argument` reaches it and must live as long. Always RMW_RET_OK.
 */
rmw_ret_t rmw_uros_set_session_callback(rmw_uros_session_callback_t callback, void * argument);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SESSION_STATE_H */
