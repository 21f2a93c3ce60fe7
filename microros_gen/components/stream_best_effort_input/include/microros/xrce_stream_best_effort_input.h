/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The best-effort input stream: what the agent sends on stream 0x01. Samples that come behind a later one, or twice, are
 * thrown away, so that they are never out of order (OMG DDS-XRCE 1.0, 8.4.12). Answers need no order: each names its request, and
 * is taken once. So a number that the agent did not give can cost some samples, and never an answer.
 */
#ifndef MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_H
#define MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All zero is the stream of a new session. */
typedef struct xrce_stream_best_effort_input_t {
  uint16_t next; /* the numbers just before this one are old; modulo 2^16 */
} xrce_stream_best_effort_input_t;

/* A session is new: the agent counts from 0. */
void xrce_stream_best_effort_input_reset(xrce_stream_best_effort_input_t * stream);

/* Returns whether samples with this number are to be handed on: it is newer than those before, or the numbers have jumped. */
bool xrce_stream_best_effort_input_take(xrce_stream_best_effort_input_t * stream, uint16_t sequence);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_H */
