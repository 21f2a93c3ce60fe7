/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Samples that are taken piece by piece while they arrive, so that they need no room here: an endpoint with
 * a sink has no queue. A piece is one fragment, or a sample that came in one message. Called while a
 * session is pumped; a sink neither pumps nor opens or closes an endpoint. Internal.
 */
#ifndef MICROROS_XRCE_SINKS_H
#define MICROROS_XRCE_SINKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_read.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Receives the samples of an endpoint; `state` is its own. A sample is `begin`, any number of `take`, then
 * `end`; `complete` is false if a piece of it is missing. Without `end` the session was lost in the middle,
 * and the next sample begins. `bytes` belong to the library and are valid during the call. */
typedef struct xrce_sink_t {
  void (*begin)(void * state, bool big_endian);
  void (*take)(void * state, const uint8_t * bytes, size_t size);
  void (*end)(void * state, bool complete);
  void * state;
} xrce_sink_t;

/* Gives an endpoint its sink, which outlives it; before the endpoint is open. */
void xrce_sinks_set(const xrce_endpoint_t * endpoint, const xrce_sink_t * sink);

/* Takes a sample that came in one message; false: its endpoint has no sink. */
bool xrce_sinks_take(xrce_client_t * client, xrce_receiver_t * receiver, const xrce_sample_t * sample);

/* Begins a sample that comes in fragments; false: its endpoint has no sink, or did not request it. */
bool xrce_sinks_begin(xrce_client_t * client, const xrce_arrival_t * arrival);

/* Takes a fragment of it; false: its endpoint has no sink, was closed, or got another sample meanwhile. */
bool xrce_sinks_add(
  xrce_client_t * client, const xrce_arrival_t * arrival, const uint8_t * bytes, size_t size);

/* Ends it; false: as above. */
bool xrce_sinks_end(xrce_client_t * client, const xrce_arrival_t * arrival, bool complete);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SINKS_H */
