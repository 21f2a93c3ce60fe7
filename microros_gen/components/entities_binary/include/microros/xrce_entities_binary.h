/* SPDX-License-Identifier: Apache-2.0 */
/* The messages that create and delete; xrce_entities.c decides when. */
#ifndef MICROROS_XRCE_ENTITIES_BINARY_H
#define MICROROS_XRCE_ENTITIES_BINARY_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the writer of a place (see xrce_entities_t.cursor). */
const xrce_writer_t * xrce_entities_writer(const xrce_client_t * client, uint16_t place);

/* Sends CREATE under client->entities.request. False: it does not fit the stream, which the plan rules out. */
bool xrce_entities_send_create(xrce_client_t * client, uint16_t place, uint16_t object, uint8_t kind);

void xrce_entities_send_delete(xrce_client_t * client, uint16_t object);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ENTITIES_BINARY_H */
