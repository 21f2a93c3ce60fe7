/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Entities of the application, as implemented by the selection: `entities` creates them at the agent and
 * deletes them, one request at a time and again after a lost session; with `entities_preconfigured` the
 * agent has already created them.
 */
#ifndef MICROROS_XRCE_ENTITIES_H
#define MICROROS_XRCE_ENTITIES_H

#include <stdint.h>

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Result of waiting for a place; every other number is the status of the agent's refusal. */
enum { XRCE_DONE = 0, XRCE_SILENT = 1 };

/* Opens a place, which is filled in. */
void xrce_entities_add(xrce_client_t * client, uint16_t place);

/* Closes a place; closing a participant also closes its endpoints. */
void xrce_entities_remove(xrce_client_t * client, uint16_t place);

/* Waits for at most `timeout_ms` until the agent has created or deleted all objects of this place. */
uint8_t xrce_entities_await(xrce_client_t * client, uint16_t place, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ENTITIES_H */
