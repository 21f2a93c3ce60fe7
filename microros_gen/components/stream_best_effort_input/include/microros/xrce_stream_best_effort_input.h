/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The best-effort input stream: messages of the agent on stream 0x01. Samples that arrive after a later
 * one, or repeatedly, are dropped, so that samples are never out of order (OMG DDS-XRCE 1.0, 8.4.12).
 * Answers need no order: each names its request and is accepted once. So a forged number can cost some
 * samples, but never an answer.
 */
#ifndef MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_H
#define MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Zero-initialized: the stream of a new session. */
typedef struct xrce_stream_best_effort_input_t {
  uint16_t next; /* the numbers just before this one are old; modulo 2^16 */
} xrce_stream_best_effort_input_t;

/* Called for a new session: the agent counts from 0. */
void xrce_stream_best_effort_input_reset(xrce_stream_best_effort_input_t * stream);

/*
 * Returns whether to process samples with this number: it is newer than earlier ones, or the numbers have
 * jumped. */
bool xrce_stream_best_effort_input_take(xrce_stream_best_effort_input_t * stream, uint16_t sequence);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_BEST_EFFORT_INPUT_H */
