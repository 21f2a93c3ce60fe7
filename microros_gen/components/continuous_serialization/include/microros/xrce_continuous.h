/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One WRITE_DATA that is sent while it is written, in fragments (OMG DDS-XRCE 1.0, 8.3.5.14), of which one is stored
 * until the agent acknowledges it. It uses a separate reliable stream (0x83), one message at a time; the other streams
 * go on meanwhile. All functions are called with the lock held.
 *
 * The agent may have fragments of a message that does not go on: after an error, or in a new session, in which some
 * agents continue to join them. An empty last fragment ends these, which are shorter than their submessage header says,
 * so the agent discards them. Internal.
 */
#ifndef MICROROS_XRCE_CONTINUOUS_H
#define MICROROS_XRCE_CONTINUOUS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_objects.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"
#include "ucdr/microcdr.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Limit for one fragment without an acknowledgement. */
#define XRCE_CONTINUOUS_TIMEOUT_MS 5000u

enum {
  XRCE_CONTINUOUS_FRONT = XRCE_MESSAGE_HEADER + XRCE_SUBMESSAGE_HEADER,
  XRCE_CONTINUOUS_ROOM = MICROROS_CONTINUOUS_SIZE - XRCE_CONTINUOUS_FRONT, /* of a fragment */
  XRCE_CONTINUOUS_LARGEST = UINT16_MAX - XRCE_WRITE_PREFIX                 /* body */
};

/* Callbacks of one publisher, both NULL without. */
typedef struct xrce_continuous_callbacks_t {
  void (*size)(uint32_t * topic_length);
  void (*serialize)(ucdrBuffer * ucdr);
} xrce_continuous_callbacks_t;

/* Zero-initialized: nothing is sent. */
typedef struct xrce_continuous_t {
  uint32_t due_ms;   /* when to repeat the outstanding message */
  uint32_t sent_ms;  /* when it was first sent */
  uint16_t sequence; /* its number, or the next one's */
  uint16_t size;     /* of the outstanding message */
  uint8_t from;      /* its first byte */
  bool busy;         /* a message is being written */
  bool begun;        /* the agent may have fragments of it */
  bool lost;         /* its session was lost */
  bool outstanding;
  bool broken; /* the agent may have fragments of a message that does not go on */
  uint8_t message[MICROROS_CONTINUOUS_SIZE];
} xrce_continuous_t;

/* Result of waiting. */
typedef enum xrce_continuous_outcome_t {
  XRCE_CONTINUOUS_DONE,
  XRCE_CONTINUOUS_TIMEOUT,
  XRCE_CONTINUOUS_LOST
} xrce_continuous_outcome_t;

/*
 * Waits until all earlier messages of the reliable stream are acknowledged and no other message is being written; then
 * the caller is the owner of client->continuous.message until xrce_continuous_end.
 */
xrce_continuous_outcome_t xrce_continuous_begin(const xrce_endpoint_t * writer);

/*
 * Sends `size` bytes (at most XRCE_CONTINUOUS_ROOM) after the front of the message, as the last fragment or not, and
 * waits until the agent has them. A first one that is the last is sent without FRAGMENT.
 */
xrce_continuous_outcome_t xrce_continuous_send(const xrce_endpoint_t * writer, size_t size, bool is_last);

/* Ends the message; `is_whole`: nothing of it is missing at the agent. */
void xrce_continuous_end(xrce_client_t * client, bool is_whole);

/* --- called by xrce_routes.c --- */

void xrce_continuous_step(xrce_client_t * client, uint32_t now);
void xrce_continuous_on_acknack(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Called for a new session. */
void xrce_continuous_renew(xrce_client_t * client);

/* Called after a sleep: addresses of functions may have changed. */
void xrce_continuous_wake(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_CONTINUOUS_H */
