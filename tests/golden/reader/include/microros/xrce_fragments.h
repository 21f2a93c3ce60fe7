/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fragments of the agent's reliable stream: DATA above the MTU comes in pieces, one message each and one behind the other
 * (OMG DDS-XRCE 1.0, 8.3.5.14). There is no buffer here: each piece goes straight to the slot in which the sample will
 * wait, which a reader has free for every sample that it asked for. What is larger than a slot is refused with its first
 * piece.
 */
#ifndef MICROROS_XRCE_FRAGMENTS_H
#define MICROROS_XRCE_FRAGMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_read.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All zero: nothing has come. */
typedef struct xrce_fragments_t {
  xrce_arrival_t sample; /* whose bytes come; valid from its first piece on */
  uint16_t arrived;      /* bytes of the sample that are in its slot */
  uint16_t next;         /* number of the message in which the next piece has to come */
  bool begun;
  bool skipping; /* up to the last piece of what cannot be had */
} xrce_fragments_t;

void xrce_fragments_reset(xrce_fragments_t * fragments);

/* Takes the payload of a FRAGMENT, whose message has just had its turn; hands on what it completes. */
void xrce_fragments_on_piece(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_FRAGMENTS_H */
