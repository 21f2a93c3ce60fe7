/* SPDX-License-Identifier: Apache-2.0 */
/* WRITE_DATA: one message of an endpoint, encoded into the stream's room. */
#ifndef MICROROS_XRCE_WRITE_H
#define MICROROS_XRCE_WRITE_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum xrce_write_t {
  XRCE_WRITTEN,          /* stored in the stream */
  XRCE_WRITE_DROPPED,    /* dropped, as configured by on_full */
  XRCE_WRITE_REFUSED,    /* a field is above its limit */
  XRCE_WRITE_FULL,       /* every slot is unacknowledged */
  XRCE_WRITE_NO_SESSION, /* no session, or the agent has not created the writer yet */
  XRCE_WRITE_NOT_SENT    /* the transport refused it */
} xrce_write_t;

/* Pumps, encodes, sends. XRCE_WRITE_REFUSED fills *fault. */
xrce_write_t xrce_write_message(xrce_endpoint_t * writer, const void * message, cdr_fault_t * fault);

/* Same for a body that is already encoded; `size` is at most xrce_route_capacity. */
xrce_write_t xrce_write_body(xrce_endpoint_t * writer, const uint8_t * body, size_t size);

/* Returns room for the writer's next submessage, or NULL without a session or room. */
uint8_t * xrce_write_reserve(const xrce_endpoint_t * writer);

/*
 * Called if there is no room: returns XRCE_WRITTEN and *room if it could make some, otherwise the reason.
 * Implemented by one of on_full_*.c. */
xrce_write_t xrce_write_on_full(xrce_endpoint_t * writer, uint8_t ** room);

/* Called if the transport has no room for a best-effort message of `size` bytes, which is in its stream:
 * returns XRCE_WRITTEN if it was sent in time; otherwise it was counted as dropped. Implemented by one of
 * on_full_*.c. */
xrce_write_t xrce_write_on_unsent(xrce_endpoint_t * writer, size_t size);

/* Returns why there is no room. */
xrce_write_t xrce_write_failure(const xrce_endpoint_t * writer);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_WRITE_H */
