/* SPDX-License-Identifier: Apache-2.0 */
/* Endpoints that receive, for the middleware layer: their places, whatever kind they are. Internal. */
#ifndef MICROROS_RMW_RECEIVER_H
#define MICROROS_RMW_RECEIVER_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/error.h"
#include "microros/rmw_names.h"
#include "microros/xrce_objects.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One kind of endpoints: its places, the number of the first among all endpoints, and what is said of it. */
typedef struct rmw_section_t {
  uint16_t first;
  uint16_t count;
  microros_error_t undeclared; /* name, type */
  microros_error_t taken;      /* name: it is open already */
  microros_error_t full;       /* name, found: how many there are, fits: how many would do */
  const char * dds_type_name;  /* of the message, or of the service */
} rmw_section_t;

/*
 * Takes a place of the section for `wanted`, whose client, type, participant and QoS are filled in, and waits for its
 * objects. RMW_RET_OK: *endpoint is the place's; RMW_RET_TIMEOUT, RMW_RET_ERROR with a text otherwise. `name` is valid;
 * `given` is how the caller wrote it.
 */
rmw_ret_t rmw_receiver_open(
  xrce_endpoint_t * wanted, const rmw_section_t * section, const rmw_name_t * name, const char * given,
  xrce_endpoint_t ** endpoint);

/* The second half of it: `wanted` has a place already. */
rmw_ret_t rmw_receiver_start(const xrce_endpoint_t * wanted);

/* Gives the place back. */
void rmw_receiver_close(const xrce_endpoint_t * endpoint);

bool rmw_receiver_is_open(const xrce_endpoint_t * endpoint);

/* Whether there is something to tell about samples that cannot be had; true, once for each: the text is set. */
bool rmw_receiver_report(const xrce_endpoint_t * endpoint);

/* One of rmw_receiver_*.c: finds a free place and fills name and index in; false, with a text: there is none. */
bool rmw_receiver_take(
  xrce_endpoint_t * wanted, const rmw_section_t * section, const rmw_name_t * name, const char * given);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_RECEIVER_H */
