/* SPDX-License-Identifier: Apache-2.0 */
/* Receiving endpoints of any kind for the middleware layer: opens and closes places. Internal. */
#ifndef MICROROS_RMW_RECEIVER_H
#define MICROROS_RMW_RECEIVER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/error.h"
#include "microros/rmw_names.h"
#include "microros/xrce_client.h"
#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One kind of endpoints: its places, the index of the first among all endpoints, and its error texts. */
typedef struct rmw_section_t {
  uint16_t first;
  uint16_t count;
  microros_error_t undeclared; /* name, type */
  microros_error_t taken;      /* name: already open */
  microros_error_t full;       /* name, found: number of places, fits: number that would suffice */
  const MICROROS_FLASH char * dds_type_name; /* of the message, or of the service */
} rmw_section_t;

/*
 * Takes a place of the section for `wanted`, whose client, type, participant and QoS are filled in, and
 * waits for its objects. RMW_RET_OK: *endpoint is the place's; otherwise RMW_RET_TIMEOUT or RMW_RET_ERROR
 * with a text. `name` is valid; `given` is the name as passed by the caller.
 */
rmw_ret_t rmw_receiver_open(
  xrce_endpoint_t * wanted, const rmw_section_t * section, const rmw_name_t * name, const char * given,
  xrce_endpoint_t ** endpoint);

/* Second half of rmw_receiver_open: `wanted` already has a place. */
rmw_ret_t rmw_receiver_start(const xrce_endpoint_t * wanted);

/* Releases the place. */
void rmw_receiver_close(const xrce_endpoint_t * endpoint);

/* After rcl_shutdown the client has no endpoints. Inline: every round of an executor asks each of its endpoints twice. */
static inline bool rmw_receiver_is_open(const xrce_endpoint_t * endpoint)
{
  return endpoint->client != NULL &&
         endpoint->client->states[(size_t)MICROROS_NODES_MAX + endpoint->index].wanted;
}

/* Returns whether samples were lost without a report; true once per loss, with the text set. */
bool rmw_receiver_report(const xrce_endpoint_t * endpoint);

/*
 * Implemented by one of rmw_receiver_*.c: finds a free place and fills in name and index. Returns false,
 * with a text, if no place is free. */
bool rmw_receiver_take(
  xrce_endpoint_t * wanted, const rmw_section_t * section, const rmw_name_t * name, const char * given);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_RECEIVER_H */
