/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fragments of the agent's reliable stream: DATA above the MTU arrives as consecutive fragments, one
 * message each  (OMG DDS-XRCE 1.0, 8.3.5.14). They need no separate buffer: each is copied to
 * the slot in which the sample will wait; a reader has a free slot for every requested sample. A sample
 * larger than a slot is refused with its first fragment.  */
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

/* Zero-initialized: nothing received. */
typedef struct xrce_fragments_t {
  xrce_arrival_t sample; /* the sample being assembled; valid from its first fragment on */
  uint16_t arrived;      /* bytes of the sample in its slot */
  uint16_t next;         /* number of the message that must contain the next fragment */
  bool begun;
  bool skipping; /* skip up to the last fragment of an incomplete sample */
} xrce_fragments_t;

void xrce_fragments_reset(xrce_fragments_t * fragments);

/* Handles the payload of a FRAGMENT in sequence; dispatches the completed submessage. */
void xrce_fragments_on_fragment(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_FRAGMENTS_H */
