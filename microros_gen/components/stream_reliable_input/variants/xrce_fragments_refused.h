/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fragments of the agent's reliable stream: DATA above the MTU arrives as consecutive fragments, one
 * message each  (OMG DDS-XRCE 1.0, 8.3.5.14). No
 * sample of this plan needs fragments, so a fragmented one is too large: it is refused with its first
 * fragment.  */
#ifndef MICROROS_XRCE_FRAGMENTS_H
#define MICROROS_XRCE_FRAGMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Zero-initialized: nothing received. */
typedef struct xrce_fragments_t {
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
