/* SPDX-License-Identifier: Apache-2.0 */
/*
 * TIMESTAMP and its reply (OMG DDS-XRCE 1.0, 8.3.5.14 and 8.3.5.15): the offset of the agent's clock to the steady one
 * of the device, from four moments.
 */
#ifndef MICROROS_XRCE_TIME_SYNC_H
#define MICROROS_XRCE_TIME_SYNC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct xrce_time_sync_t {
  int64_t since_ns;      /* questions from this moment on count, by port_time_steady_ns */
  int64_t offset_ns;     /* to be added to port_time_steady_ns; 0 before the first answer */
  int64_t round_trip_ns; /* of the answer that the offset is from */
  uint8_t callers;       /* who wait for an answer: without any, none counts */
  uint8_t answers;       /* whoever waits sees that it changes */
  bool synchronized;
} xrce_time_sync_t;

/* Somebody begins to wait for an answer, and ends. */
void xrce_time_sync_begin(xrce_time_sync_t * sync);
void xrce_time_sync_end(xrce_time_sync_t * sync);

/* Asks once, in a session. What is lost is to be asked again. */
void xrce_time_sync_ask(xrce_client_t * client);

/*
 * Takes an answer to any question of those who wait; of several, that with the shortest round trip, since half of it is
 * what the offset may be wrong by. Others are ignored, what is none counts as malformed.
 */
void xrce_time_sync_on_reply(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TIME_SYNC_H */
