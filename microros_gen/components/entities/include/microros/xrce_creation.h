/* SPDX-License-Identifier: Apache-2.0 */
/*
 * CREATE and DELETE. One request is outstanding at a time; a place that is given back is deleted in the background. When
 * a request is due is decided in xrce_entities.c, on which stream it goes in xrce_creation_*.c, and how an object is
 * described in the component entities_binary, entities_xml or entities_reference.
 */
#ifndef MICROROS_XRCE_CREATION_H
#define MICROROS_XRCE_CREATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_entities.h"
#include "microros/xrce_objects.h"
#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct xrce_entities_t {
  uint32_t due_ms;   /* while xrce_entities_waits: when to go on */
  uint32_t asked_ms; /* when the outstanding request was sent first */
  uint16_t request;
  uint16_t cursor;        /* the place that the request is about */
  uint16_t refused_place; /* the last place that was refused, and why */
  uint8_t refused_status;
  uint8_t refusals; /* in a row */
  bool outstanding;
  bool deleting;
  bool pending; /* something may have to be created or deleted */
  bool resting; /* the agent refused the last request a moment ago */
} xrce_entities_t;

/* Whether due_ms counts: a request is out, or was refused. Else what is pending can go at once. */
static inline bool xrce_entities_waits(const xrce_entities_t * entities)
{
  return entities->outstanding || entities->resting;
}

/* What xrce_routes.c calls. */
void xrce_entities_renew(xrce_client_t * client);
void xrce_entities_step(xrce_client_t * client, uint32_t now);
void xrce_entities_on_status(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Whether every wanted entity is at the agent. */
bool xrce_entities_settled(const xrce_client_t * client);

/* Returns the endpoint of a place. */
const xrce_endpoint_t * xrce_entities_endpoint(const xrce_client_t * client, uint16_t place);

/*
 * The stream, as one of xrce_creation_*.c has it. Whether a new request may go now; without one, nothing is taken.
 */
bool xrce_creation_begin(xrce_client_t * client, uint32_t now);

/* Returns room for the one submessage of a request. */
uint8_t * xrce_creation_room(xrce_client_t * client);

/* Sends the room's first `size` bytes. Until the STATUS comes the request is sent again, with the same bytes. */
void xrce_creation_send(xrce_client_t * client, size_t size);

/* The STATUS of the request came. */
void xrce_creation_end(xrce_client_t * client);

/* Ways to describe an object (OMG DDS-XRCE 1.0, 7.7.3). */
enum { XRCE_FORMAT_REFERENCE = 0x01, XRCE_FORMAT_XML = 0x02, XRCE_FORMAT_BINARY = 0x03 };

/*
 * Describes the place's object of this kind, as the selected component does: writes the bytes to `blob`, their format to
 * *format, and returns their end. There is room, since the plan knows the longest.
 */
uint8_t * xrce_describe(
  const xrce_client_t * client, uint16_t place, uint8_t kind, uint8_t * blob, uint8_t * format);

/* The same for a replier or requester, of the same component; where none is selected there is none. */
uint8_t * xrce_describe_service(
  const xrce_client_t * client, uint16_t place, uint8_t * blob, uint8_t * format);

/* Copies the characters of `text` and returns their end. */
uint8_t * xrce_describe_text(uint8_t * at, const char * text);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CREATION_H */
