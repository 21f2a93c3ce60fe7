/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Requests that are larger than the slot they would wait in. They are refused and reported as any sample is, and their
 * beginning waits in their place: so the service can answer them, in their turn. Internal.
 */
#ifndef MICROROS_XRCE_PARAMETERS_H
#define MICROROS_XRCE_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "microros/xrce_wire.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes of the beginning: the identity, and the length of the list that the request begins with. */
enum { XRCE_PARAMETERS_BEGINNING = XRCE_IDENTITY_SIZE + 4 };

/* Sets whether the service of an endpoint answers such requests. */
void xrce_parameters_answer_large(const xrce_endpoint_t * endpoint, bool answers);

/* --- called by xrce_routes.c --- */

void xrce_parameters_on_data(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* The fragments of a sample come in their order, the first with its beginning. */
void xrce_parameters_on_fragment(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Called for a new session: a sample of the old one has no further fragments. */
void xrce_parameters_renew(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PARAMETERS_H */
