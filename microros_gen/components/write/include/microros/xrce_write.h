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
  XRCE_WRITTEN,          /* the stream has it */
  XRCE_WRITE_DROPPED,    /* given up, as the application file says */
  XRCE_WRITE_REFUSED,    /* a field is above its limit */
  XRCE_WRITE_FULL,       /* every slot is unacknowledged */
  XRCE_WRITE_NO_SESSION, /* no session, or the agent has the writer not yet */
  XRCE_WRITE_NOT_SENT    /* the transport did not take it */
} xrce_write_t;

/* Pumps, encodes, sends. XRCE_WRITE_REFUSED fills *fault. */
xrce_write_t xrce_write_message(xrce_endpoint_t * writer, const void * message, cdr_fault_t * fault);

/* The same with a body that is encoded already; `size` is not above xrce_route_capacity. */
xrce_write_t xrce_write_body(xrce_endpoint_t * writer, const uint8_t * body, size_t size);

/* Returns room for the writer's next submessage, or NULL: no session, or no room. */
uint8_t * xrce_write_reserve(const xrce_endpoint_t * writer);

/* There is no room: XRCE_WRITTEN and *room when there is now, else why not. One of on_full_*.c is there. */
xrce_write_t xrce_write_on_full(xrce_endpoint_t * writer, uint8_t ** room);

/* The transport has no room for a best-effort message of `size` bytes, which is in its stream: XRCE_WRITTEN when there was
 * some in time, else it was counted as given up. One of on_full_*.c is there. */
xrce_write_t xrce_write_on_unsent(xrce_endpoint_t * writer, size_t size);

/* Why there is no room. */
xrce_write_t xrce_write_obstacle(const xrce_endpoint_t * writer);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_WRITE_H */
