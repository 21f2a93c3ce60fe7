/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One reply that is larger than a slot of the reliable stream: a WRITE_DATA in fragments (OMG DDS-XRCE 1.0, 8.3.5.14),
 * each of which is written when it is sent, and written again when it is repeated. So the reply is stored nowhere. It
 * uses a separate reliable stream (0x82), one message at a time, as READ_DATA does; other messages go on meanwhile.
 *
 * In a new session the reply starts again. An agent may still join fragments of the old one: an empty last fragment
 * ends them, which is shorter than its submessage header says, so the agent discards it. Internal.
 */
#ifndef MICROROS_XRCE_PARTS_H
#define MICROROS_XRCE_PARTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { XRCE_PARTS_HEAD_SIZE = XRCE_WRITE_PREFIX + XRCE_IDENTITY_SIZE };

/* Writes the bytes of a body from `from` on, at most `size`, to `to`. Returns the size of the whole body. */
typedef uint32_t (*xrce_parts_body_t)(uint32_t from, uint32_t size, uint8_t * to);

/* Zero-initialized: nothing is sent. */
typedef struct xrce_parts_t {
  xrce_parts_body_t body; /* NULL: not known yet */
  uint32_t due_ms;        /* when to repeat the outstanding part */
  uint32_t sent_ms;       /* when it was first sent */
  uint32_t position;      /* its first byte, after the submessage header */
  uint32_t size;          /* bytes of the whole submessage */
  uint16_t sequence;      /* its number, or the next one's */
  uint16_t endpoint;      /* index of the replier */
  bool busy;
  bool outstanding;
  bool broken;                        /* the agent has a part of a reply that does not go on */
  uint8_t head[XRCE_PARTS_HEAD_SIZE]; /* bytes of the submessage before its body */
} xrce_parts_t;

/* Begins a reply of the endpoint, unless another one is under way or `parts.body` is not known. */
void xrce_parts_begin(xrce_client_t * client, uint16_t endpoint, const uint8_t * identity);

/* --- called by xrce_routes.c --- */

void xrce_parts_step(xrce_client_t * client, uint32_t now);
void xrce_parts_on_acknack(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Called for a new session. */
void xrce_parts_renew(xrce_client_t * client);

/* Called after a sleep: addresses of functions may have changed. */
void xrce_parts_wake(xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_PARTS_H */
