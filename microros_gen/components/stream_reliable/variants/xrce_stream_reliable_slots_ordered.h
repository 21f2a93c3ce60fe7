/* SPDX-License-Identifier: Apache-2.0 */
/* Storage of the reliable output stream. Only its own sources and what retains it during a sleep include this. */
#ifndef MICROROS_XRCE_STREAM_RELIABLE_SLOTS_H
#define MICROROS_XRCE_STREAM_RELIABLE_SLOTS_H

#include <stdint.h>

#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The messages of the only client's stream. They are not in the client, so that a changed limit leaves all other
 * sources as they are. Small members come first: their offsets have short instructions. */
typedef struct xrce_reliable_slots_t {
  uint8_t order[MICROROS_RELIABLE_SLOTS]; /* slot of the i-th message, XORed with i */
  uint16_t size[MICROROS_RELIABLE_SLOTS]; /* of the submessages of a message */
  uint8_t message[MICROROS_RELIABLE_SLOTS][MICROROS_RELIABLE_SLOT_SIZE];
} xrce_reliable_slots_t;

extern xrce_reliable_slots_t xrce_reliable_slots;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_SLOTS_H */
