/* SPDX-License-Identifier: Apache-2.0 */
/* A frame produced during transmission, from a message that stays unchanged until it is sent. */
#ifndef MICROROS_XRCE_FRAMING_KEPT_H
#define MICROROS_XRCE_FRAMING_KEPT_H

#include "microros/xrce_framing.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Its message belongs to the sender. */
typedef struct xrce_frame_t {
  const uint8_t * message;
  uint32_t at; /* unstuffed bytes produced so far, including the flag */
  uint16_t size;
  uint16_t crc;
  uint8_t stuffed; /* byte that follows the 7D just produced, or 0 */
} xrce_frame_t;

void xrce_frame_begin(xrce_frame_t * frame, const uint8_t * message, uint16_t size);

/* Returns the next byte for the line, -1 at the end. One caller at a time per frame, which may be an
 * interrupt; `context` is the frame. */
int32_t xrce_frame_next(void * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_FRAMING_KEPT_H */
