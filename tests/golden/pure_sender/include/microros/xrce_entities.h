/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Creating and deleting entities, in whatever way the selection has (entities_binary and its siblings
 * implement these). One request is outstanding at a time and repeated with growing pauses until its STATUS
 * comes; a place that is given back is deleted in the background.
 */
#ifndef MICROROS_XRCE_ENTITIES_H
#define MICROROS_XRCE_ENTITIES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum xrce_outcome_t { XRCE_DONE, XRCE_SILENT, XRCE_REFUSED } xrce_outcome_t;

typedef struct xrce_entities_t {
  uint32_t due_ms;
  uint16_t request;
  uint16_t cursor;        /* the place that the request is about */
  uint16_t refused_place; /* the last place that was refused, and why */
  uint8_t refused_status;
  bool outstanding;
  bool deleting;
  bool pending; /* something may have to be created or deleted */
} xrce_entities_t;

void xrce_entities_renew(xrce_client_t * client, uint32_t now);
void xrce_entities_step(xrce_client_t * client, uint32_t now);
void xrce_entities_on_status(xrce_client_t * client, const uint8_t * payload, size_t size, uint32_t now);
bool xrce_entities_settled(const xrce_client_t * client);

/* Whether the writer's topic and type can be sent: always, for types of the plan. */
bool xrce_entities_fits(const xrce_writer_t * writer);

/* The application opens a place: what it is to be is filled in. */
void xrce_entities_add(xrce_client_t * client, uint16_t place);

/* The application closes a place; with a participant go its writers. */
void xrce_entities_remove(xrce_client_t * client, uint16_t place);

/* Waits at most `timeout_ms` until the agent has what is wanted of this place, or has let it go. */
xrce_outcome_t xrce_entities_await(xrce_client_t * client, uint16_t place, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_ENTITIES_H */
