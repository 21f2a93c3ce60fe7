/* SPDX-License-Identifier: Apache-2.0 */
/* A frame that is made while it is sent, out of a message that stays as it is until then. */
#ifndef MICROROS_XRCE_FRAMING_KEPT_H
#define MICROROS_XRCE_FRAMING_KEPT_H

#include "microros/xrce_framing.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Its message belongs to whoever began it. */
typedef struct xrce_frame_t {
  const uint8_t * message;
  uint32_t at; /* bytes that were given, the flag among them, unstuffed */
  uint16_t size;
  uint16_t crc;
  uint8_t stuffed; /* what follows the 7D that was given last, or 0 */
} xrce_frame_t;

void xrce_frame_begin(xrce_frame_t * frame, const uint8_t * message, uint16_t size);

/* Returns the next byte of the line, -1 behind the last. Of one frame one caller at a time, which may be an interrupt;
 * `context` is the frame. */
int32_t xrce_frame_next(void * context);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_FRAMING_KEPT_H */
