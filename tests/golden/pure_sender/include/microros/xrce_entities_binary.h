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

/* Returns the writer of a place. */
const xrce_writer_t * xrce_entities_writer(const xrce_client_t * client, uint16_t place);

/* Sends CREATE of the place's object number `level` under client->entities.request. */
void xrce_entities_send_create(xrce_client_t * client, uint16_t place, uint8_t level);

void xrce_entities_send_delete(xrce_client_t * client, uint16_t place, uint8_t level);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ENTITIES_BINARY_H */
