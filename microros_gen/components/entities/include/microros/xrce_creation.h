/* SPDX-License-Identifier: Apache-2.0 */
/*
 * CREATE and DELETE. At most one request is outstanding; the objects of a released place are deleted in
 * the background. xrce_entities.c decides when to send a request, xrce_creation_stream.h on which stream; the
 * components entities_binary, entities_xml and entities_reference describe objects.
 */
#ifndef MICROROS_XRCE_CREATION_H
#define MICROROS_XRCE_CREATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "microros/flash.h"
#include "microros/xrce_entities.h"
#include "microros/xrce_objects.h"
#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Places whose objects may have to be created or deleted: none, any, or that of the cursor. */
enum { XRCE_PENDING_NONE = 0, XRCE_PENDING_ANY = 1, XRCE_PENDING_ONE = 2 };

typedef struct xrce_entities_t {
  uint32_t due_ms;       /* while xrce_entities_waits: time of the next action */
  uint32_t requested_ms; /* when the outstanding request was first sent */
  uint16_t request;
  uint16_t cursor;        /* place of the outstanding request */
  uint16_t refused_place; /* the last refused place, and its status */
  uint8_t refused_status;
  uint8_t refusals; /* consecutive refusals */
  bool outstanding;
  bool deleting;
  uint8_t pending; /* XRCE_PENDING_ */
  bool resting;    /* the agent has just refused a request */
} xrce_entities_t;

/*
 * Returns whether due_ms is valid: a request is outstanding or was refused. Otherwise pending work can be
 * sent at once. */
static inline bool xrce_entities_waits(const xrce_entities_t * entities)
{
  return entities->outstanding || entities->resting;
}

/* Called by xrce_routes.c. */
void xrce_entities_renew(xrce_client_t * client);
void xrce_entities_step(xrce_client_t * client, uint32_t now);
void xrce_entities_on_status(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Returns the endpoint of a place. */
const xrce_endpoint_t * xrce_entities_endpoint(const xrce_client_t * client, uint16_t place);

/* Representations of an object (OMG DDS-XRCE 1.0, 7.7.3). */
enum { XRCE_FORMAT_REFERENCE = 0x01, XRCE_FORMAT_XML = 0x02, XRCE_FORMAT_BINARY = 0x03 };

/*
 * Describes the object of this kind at a place in the representation of the selected component: writes the
 * bytes to `blob`, their format to *format, and returns their end. The plan guarantees room for the
 * longest description.
 */
uint8_t * xrce_describe(
  const xrce_client_t * client, uint16_t place, uint8_t kind, uint8_t * blob, uint8_t * format);

/* Copies the characters of `text` without the terminator; returns their end. */
uint8_t * xrce_describe_text(uint8_t * at, const MICROROS_ANYWHERE char * text);

/* The same for a text of `size` bytes, which takes a quarter of the time where all memory has the same pointers. */
static inline uint8_t * xrce_describe_sized(uint8_t * at, const MICROROS_ANYWHERE char * text, size_t size)
{
#if defined(MICROROS_FLASH_IS_SEPARATE)
  (void)size;
  return xrce_describe_text(at, text);
#else
  (void)memcpy(at, text, size); /* at most MICROROS_CREATION_SIZE or MICROROS_MTU bytes */
  return &at[size];
#endif
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CREATION_H */
