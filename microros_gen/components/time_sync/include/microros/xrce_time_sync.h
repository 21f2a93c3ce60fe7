/* SPDX-License-Identifier: Apache-2.0 */
/*
 * TIMESTAMP and its reply (OMG DDS-XRCE 1.0, 8.3.5.15 and 8.3.5.16): the offset of the agent's clock to the steady
 * clock of the device, from four points in time.
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
  int64_t since_ns;      /* requests from this time on count, by port_time_steady_ns */
  int64_t offset_ns;     /* added to port_time_steady_ns; 0 before the first answer */
  int64_t round_trip_ns; /* of the answer that determined the offset */
  uint8_t callers;       /* waiting callers; answers are ignored if it is 0 */
  uint8_t replies;       /* changes with each answer */
  bool synchronized;
} xrce_time_sync_t;

/* A caller starts and stops waiting for an answer. */
void xrce_time_sync_begin(xrce_time_sync_t * sync);
void xrce_time_sync_end(xrce_time_sync_t * sync);

/* Sends one request in an open session. Lost messages are not repeated here. */
void xrce_time_sync_request(xrce_client_t * client);

/*
 * Handles an answer to any request of the waiting callers. Of several, the one with the shortest round
 * trip is used, since half of that bounds the error of the offset. Other answers are ignored; malformed
 * ones are counted.
 */
void xrce_time_sync_on_reply(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TIME_SYNC_H */
