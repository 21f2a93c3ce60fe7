/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fragments of the agent's reliable stream: DATA above the MTU comes in pieces, one message each and one behind the other
 * (OMG DDS-XRCE 1.0, 8.3.5.14). All samples of this plan come whole, so such a one is too large: it is refused with its
 * first piece.
 */
#ifndef MICROROS_XRCE_FRAGMENTS_H
#define MICROROS_XRCE_FRAGMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All zero: nothing has come. */
typedef struct xrce_fragments_t {
  bool skipping; /* up to the last piece of what cannot be had */
} xrce_fragments_t;

void xrce_fragments_reset(xrce_fragments_t * fragments);

/* Takes the payload of a FRAGMENT, whose message has just had its turn; hands on what it completes. */
void xrce_fragments_on_piece(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_FRAGMENTS_H */
