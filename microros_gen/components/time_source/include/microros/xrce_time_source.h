/* SPDX-License-Identifier: Apache-2.0 */
/* The source of the time of a client: samples of the agent, asked for once in a period, or of the application. Internal. */
#ifndef MICROROS_XRCE_TIME_SOURCE_H
#define MICROROS_XRCE_TIME_SOURCE_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_time_filter.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Zero-initialized: the time is not known yet. The members after `filter` are those of questions to the agent. */
typedef struct xrce_time_source_t {
  xrce_time_filter_t filter;
  uint32_t due_ms;   /* when to ask */
  uint32_t since_ms; /* start of asking */
  uint8_t replies;   /* client->time_sync.replies that were taken */
  bool asks;
} xrce_time_source_t;

/* Takes a sample. Before the first one, what the agent has said so far is what is served. False: it is an outlier. */
bool xrce_time_source_take(xrce_client_t * client, const xrce_time_sample_t * sample, int64_t now_ns);

/* Asks the agent when it is due, until an answer has arrived, and takes each answer, also one to the application. */
void xrce_time_source_step(xrce_client_t * client, uint32_t now);

/* Returns the time until a question is due, at most `left`. */
uint32_t xrce_time_source_left(const xrce_client_t * client, uint32_t left, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TIME_SOURCE_H */
