/* SPDX-License-Identifier: Apache-2.0 */
/* Dispatch to the selected components: generated, so that nothing else is called or linked. */
#ifndef MICROROS_XRCE_ROUTES_H
#define MICROROS_XRCE_ROUTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_mark.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Passes a received message to its stream, which dispatches its submessages in order. `size` is at least a
 * header. Returns false for a malformed message. */
bool xrce_route_message(xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now);

/*
 * Passes a received submessage to its handlers; unknown ones are ignored. The submessage starts at its
 * header and is in the input buffer during the call; `size` is that of its payload, `now` the start of the
 * pump. Handlers in component.yaml below `on:` have the same parameters.
 */
void xrce_route_submessage(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Runs the periodic work of every component. */
void xrce_route_step(xrce_client_t * client, uint32_t now);

/* Resets every component for a new session: the agent counts from 0 and may have no objects. */
void xrce_route_connected(xrce_client_t * client, uint32_t now);

/* Closes the session at the agent, or if the plan has no such message, waits until the line has sent
 * everything, for at most client->close_timeout_ms; then closes the transport. */
void xrce_route_close(xrce_client_t * client);

/*
 * Returns room for one submessage in the stream, or NULL if the stream is full; a second call without
 * xrce_route_commit returns the same room. Its size is xrce_route_capacity.
 */
uint8_t * xrce_route_reserve(xrce_client_t * client, bool reliable);

/* Sends `size` reserved bytes. Returns false if the transport refused a best-effort message. */
bool xrce_route_commit(xrce_client_t * client, bool reliable, size_t size);

/* Returns the largest message body of the stream in bytes; 0 if the plan has no such stream. */
size_t xrce_route_capacity(bool reliable);

/* Drops the oldest unacknowledged reliable message and returns its submessage, valid until the next
 * reservation; NULL without one that may be dropped. */
const uint8_t * xrce_route_drop_oldest(xrce_client_t * client);

/* Returns the number of unacknowledged reliable messages. */
uint16_t xrce_route_unacknowledged(const xrce_client_t * client);

/* Returns whether every reliable message is acknowledged that was stored at the first call with `mark`. */
bool xrce_route_has_passed(const xrce_client_t * client, xrce_mark_t * mark);

/* Returns whether every wanted entity exists at the agent. */
bool xrce_route_settled(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ROUTES_H */
