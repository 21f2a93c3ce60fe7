/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The entities of the application, in whatever way the selection has: `entities` creates them at the agent and deletes
 * them, one request after the other and again after a lost session; with `entities_preconfigured` they are there.
 */
#ifndef MICROROS_XRCE_ENTITIES_H
#define MICROROS_XRCE_ENTITIES_H

#include <stdint.h>

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How waiting for a place ended; every other number is the status that the agent refused it with. */
enum { XRCE_DONE = 0, XRCE_SILENT = 1 };

/* The application opens a place: what it is to be is filled in. */
void xrce_entities_add(xrce_client_t * client, uint16_t place);

/* The application closes a place; with a participant go its endpoints. */
void xrce_entities_remove(xrce_client_t * client, uint16_t place);

/* Waits at most `timeout_ms` until the agent has what is wanted of this place, or has let it go. */
uint8_t xrce_entities_await(xrce_client_t * client, uint16_t place, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ENTITIES_H */
