/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Notification about changes of the session: an addition of this client to rmw_microros. The application
 * does not have to react: the session reconnects and re-creates its entities by itself.
 */
#ifndef MICROROS_RMW_MICROROS_SESSION_STATE_H
#define MICROROS_RMW_MICROROS_SESSION_STATE_H

#include <stdint.h>

#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* CONNECTING, CONNECTED; then LOST, RECONNECTING, CONNECTED for each loss of the agent; CLOSED. */
typedef enum rmw_uros_session_state_t {
  RMW_UROS_SESSION_CLOSED,      /* by rcl_shutdown */
  RMW_UROS_SESSION_CONNECTING,  /* rcl_init is connecting to the agent */
  RMW_UROS_SESSION_CONNECTED,   /* the session is open; after a loss: and all entities exist again */
  RMW_UROS_SESSION_LOST,        /* the session starts to reconnect */
  RMW_UROS_SESSION_RECONNECTING /* the agent has answered, entities are being re-created */
} rmw_uros_session_state_t;

/* Why a session is lost. */
typedef enum rmw_uros_session_reason_t {
  RMW_UROS_REASON_NONE,
  RMW_UROS_REASON_SILENT,         /* the agent does not answer (liveliness: ping) */
  RMW_UROS_REASON_FORGOTTEN,      /* the agent does not know the session: it has restarted */
  RMW_UROS_REASON_UNACKNOWLEDGED, /* reliable data stays unacknowledged (liveliness: acknack) */
  RMW_UROS_REASON_BROKEN,         /* the connection was closed (TCP) */
  RMW_UROS_REASON_REFUSED         /* a new session was refused; the request is repeated */
} rmw_uros_session_reason_t;

/* Counters since rcl_init, as in rmw_uros_statistics_t. */
typedef struct rmw_uros_session_event_t {
  rmw_uros_session_state_t state;
  rmw_uros_session_reason_t reason; /* of LOST, otherwise NONE */
  uint32_t losses;                  /* sessions lost */
  uint32_t reconnects;              /* sessions opened after a loss */
  uint32_t dropped;                 /* messages that could not be sent or stored */
} rmw_uros_session_event_t;

/*
 * `event` is valid during the call. The callback must return soon and must not call functions that take an
 * entity or a context. */
typedef void (*rmw_uros_session_callback_t)(const rmw_uros_session_event_t * event, void * argument);

/*
 * Sets the callback; NULL removes it. It can be set before rcl_init and persists after rcl_shutdown. It is
 * called from functions of this library in the task that calls them: publish, take, spin or wait.
 * `argument` is passed to it and must stay valid. Always returns RMW_RET_OK.
 */
rmw_ret_t rmw_uros_set_session_callback(rmw_uros_session_callback_t callback, void * argument);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_SESSION_STATE_H */
