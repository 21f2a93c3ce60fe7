/* SPDX-License-Identifier: Apache-2.0 */
/* Notifies a listener about changes of the session's state. */
#ifndef MICROROS_XRCE_WATCH_H
#define MICROROS_XRCE_WATCH_H

#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum xrce_watch_state_t {
  XRCE_WATCH_CLOSED,
  XRCE_WATCH_CONNECTING,
  XRCE_WATCH_CONNECTED,
  XRCE_WATCH_LOST,
  XRCE_WATCH_RECONNECTING
} xrce_watch_state_t;

/* Why a session was lost. */
typedef enum xrce_watch_reason_t {
  XRCE_WATCH_NO_REASON,
  XRCE_WATCH_SILENT,
  XRCE_WATCH_FORGOTTEN,
  XRCE_WATCH_UNACKNOWLEDGED,
  XRCE_WATCH_BROKEN,
  XRCE_WATCH_REFUSED
} xrce_watch_reason_t;

/* Zero-initialized: closed, nothing reported. */
typedef struct xrce_watch_t {
  uint32_t losses;
  uint8_t state;  /* xrce_watch_state_t, last reported */
  uint8_t reason; /* xrce_watch_reason_t, of the last loss */
} xrce_watch_t;

/* Called after client->watch has changed, by the task that pumps the client. */
typedef void (*xrce_watch_listener_t)(const xrce_client_t * client);

/* Sets the listener; NULL removes it. It persists across sessions. */
void xrce_watch_set_listener(xrce_watch_listener_t listener);

/* For xrce_routes.c: reports changes. */
void xrce_watch_step(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_WATCH_H */
