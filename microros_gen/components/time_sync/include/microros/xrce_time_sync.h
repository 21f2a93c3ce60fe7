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
  int64_t asked_ns;  /* when the outstanding question was sent, by port_time_steady_ns */
  int64_t offset_ns; /* to be added to port_time_steady_ns; 0 before the first answer */
  bool outstanding;
  bool synchronized;
} xrce_time_sync_t;

/* Asks once; an answer to an earlier question no longer counts. False: the transport did not take it. */
bool xrce_time_sync_ask(xrce_client_t * client);

/* Takes an answer: what does not belong to the outstanding question is ignored, what is none counts as malformed. */
void xrce_time_sync_on_reply(xrce_client_t * client, const uint8_t * payload, size_t size, uint8_t flags);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TIME_SYNC_H */
