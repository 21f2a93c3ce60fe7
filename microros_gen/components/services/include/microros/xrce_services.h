/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Writing of repliers and requesters. A reply carries the identity of its request; a request has a 16-bit
 * number on the wire that identifies its reply. Both use the reliable streams.
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

/* Service part of an endpoint, in addition to xrce_endpoint_t, whose `type` is the received one. */
typedef struct xrce_service_t {
  const microros_service_type_t * type;
  const microros_message_type_t * sent; /* with the limits of this endpoint */
} xrce_service_t;

/* A request without a reply; zero-initialized: none. */
typedef struct xrce_request_t {
  uint32_t sequence; /* low half of its sequence number */
  uint16_t request;  /* its number on the wire */
} xrce_request_t;

/* Requests of a client. `given_up`: requests replaced by newer ones; `interrupted`: those outstanding when
 * a session was lost, `unreported` of them not yet reported. */
typedef struct xrce_requester_t {
  int64_t sequence; /* of the last request */
  uint32_t given_up;
  uint32_t interrupted;
  uint32_t unreported;
} xrce_requester_t;

/* Returns the service part of an endpoint. */
xrce_service_t * xrce_service_of(const xrce_endpoint_t * endpoint);

/* Pumps, encodes, sends. `identity` is NULL for a request, otherwise the reply's XRCE_IDENTITY_SIZE bytes.
 * XRCE_WRITE_REFUSED fills *fault. */
xrce_write_t xrce_service_write(
  xrce_endpoint_t * endpoint, uint16_t request, const uint8_t * identity, const void * message,
  cdr_fault_t * fault);

/* --- of clients --- */

xrce_requester_t * xrce_requests_of(const xrce_endpoint_t * endpoint);

/* Called for a new owner: clears requests and counters. */
void xrce_requests_open(const xrce_endpoint_t * endpoint);

/* Records a request sent with this number, and returns its sequence number. If as many are outstanding as
 * there is room for replies, the oldest is dropped. */
int64_t xrce_requests_add(const xrce_endpoint_t * endpoint, uint16_t request);

/*
 * Called for a reply: returns the sequence number of its request, once. False: no such request is
 * outstanding. */
bool xrce_requests_take(const xrce_endpoint_t * endpoint, uint16_t request, int64_t * sequence);

/* Called for a new session: outstanding requests may get no reply. Called by xrce_routes.c. */
void xrce_requests_renew(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SERVICES_H */
