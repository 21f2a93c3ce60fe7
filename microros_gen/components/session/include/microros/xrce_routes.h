/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Where the ways part: generated for the selection, so that nothing that is not selected is called or linked.
 */
#ifndef MICROROS_XRCE_ROUTES_H
#define MICROROS_XRCE_ROUTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Hands a received message to its stream, which hands on its submessages when it is their turn. `size` is at least a
 * header's. False: it is not what it should be. */
bool xrce_route_message(xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now);

/*
 * Hands a received submessage to the parts that understand it; one that nobody does is ignored. It begins at its header and
 * lies in the input during the call; `size` is that of its payload, `now` when the pump began. What component.yaml names
 * below `on:` has the same parameters.
 */
void xrce_route_submessage(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Lets every part do what is due. */
void xrce_route_step(xrce_client_t * client, uint32_t now);

/* Starts every part again: the agent counts from 0 and may have nothing. */
void xrce_route_connected(xrce_client_t * client, uint32_t now);

/* Takes leave of the agent, or, where the plan has no way to, lets what waits for the line leave it, for at most
 * client->close_timeout_ms; then closes. */
void xrce_route_close(xrce_client_t * client);

/*
 * Returns room for one submessage in the stream, or NULL when it has none; a second call without
 * xrce_route_commit gives the same room. The room is what xrce_route_capacity says.
 */
uint8_t * xrce_route_reserve(xrce_client_t * client, bool reliable);

/* Sends what was reserved, `size` bytes. False: a best-effort message that the transport did not take. */
bool xrce_route_commit(xrce_client_t * client, bool reliable, size_t size);

/* Returns the largest message body that the stream takes, in bytes; 0 for a stream that the plan does not
 * have. */
size_t xrce_route_capacity(bool reliable);

/* Forgets the oldest unacknowledged reliable message, and returns its submessage, to be read until the next one is
 * reserved; NULL: there is none. */
const uint8_t * xrce_route_drop_oldest(xrce_client_t * client);

/* Returns how many reliable messages the agent has not acknowledged. */
uint16_t xrce_route_unacknowledged(const xrce_client_t * client);

/* Returns whether every wanted entity exists at the agent. */
bool xrce_route_settled(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ROUTES_H */
