/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages that are larger than their slot. They are refused and reported as other samples are, but their first bytes
 * are kept, so that a service can answer such a request and a client can end its call, in order. Internal.
 */
#ifndef MICROROS_XRCE_PARAMETERS_H
#define MICROROS_XRCE_PARAMETERS_H

#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* First bytes of a request: the identity, and the length of its first list. */
enum { XRCE_PARAMETERS_BEGINNING = XRCE_IDENTITY_SIZE + 4 };

/* Sets how many bytes of such messages an endpoint gets, at most XRCE_PARAMETERS_BEGINNING; 0: none of them. */
void xrce_parameters_keep_beginning(const xrce_endpoint_t * endpoint, uint8_t size);

/* --- called by xrce_routes.c --- */

void xrce_parameters_on_data(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* The fragments of a sample arrive in order; the first one has its first bytes. */
void xrce_parameters_on_fragment(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Called for a new session: no fragments of an old sample follow. */
void xrce_parameters_renew(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PARAMETERS_H */
