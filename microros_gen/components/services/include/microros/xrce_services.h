/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What repliers and requesters send. A reply goes with the identity that its request came with; a request has a number on
 * the wire (16 bits) by which its reply is known. Both are on the reliable streams.
 */
#ifndef MICROROS_XRCE_SERVICES_H
#define MICROROS_XRCE_SERVICES_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/service_type.h"
#include "microros/xrce_objects.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the endpoint of a service has beside xrce_endpoint_t, whose `type` is that of what it receives. */
typedef struct xrce_service_t {
  const microros_service_type_t * type;
  const microros_message_type_t * sent; /* under the limits of this endpoint */
} xrce_service_t;

/* A request without a reply; all zero: none. */
typedef struct xrce_request_t {
  uint32_t sequence; /* the low half of its sequence number */
  uint16_t request;  /* its number on the wire */
} xrce_request_t;

/* A client's requests. `given_up`: requests that made room for newer ones; `interrupted`: those that were under way when a
 * session was lost, `untold` of them since this was told. */
typedef struct xrce_requester_t {
  int64_t sequence; /* of the last request */
  uint32_t given_up;
  uint32_t interrupted;
  uint32_t untold;
} xrce_requester_t;

/* Returns what the endpoint of a service has. */
xrce_service_t * xrce_service_of(const xrce_endpoint_t * endpoint);

/* Pumps, encodes, sends. `identity` is NULL for a request, and a reply's XRCE_IDENTITY_SIZE bytes. XRCE_WRITE_REFUSED fills
 * *fault. */
xrce_write_t xrce_service_write(
  xrce_endpoint_t * endpoint, uint16_t request, const uint8_t * identity, const void * message,
  cdr_fault_t * fault);

/* --- of clients --- */

xrce_requester_t * xrce_requests_of(const xrce_endpoint_t * endpoint);

/* The endpoint has a new owner: no requests, all counters 0. */
void xrce_requests_open(const xrce_endpoint_t * endpoint);

/* Notes a request that was sent under this number, and returns its sequence number. Where as many are under way as replies
 * would find room, the oldest is given up. */
int64_t xrce_requests_add(const xrce_endpoint_t * endpoint, uint16_t request);

/* The reply to this number is here: gives its sequence number, once. False: nobody waits for it. */
bool xrce_requests_take(const xrce_endpoint_t * endpoint, uint16_t request, int64_t * sequence);

/* A new session: what was under way may have no reply. What xrce_routes.c calls. */
void xrce_requests_renew(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERVICES_H */
