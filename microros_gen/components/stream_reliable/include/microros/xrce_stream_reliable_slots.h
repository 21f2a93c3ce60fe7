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
 * sources as they are. */
extern uint8_t xrce_reliable_slots[MICROROS_RELIABLE_SLOTS][MICROROS_RELIABLE_SLOT_SIZE];

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_STREAM_RELIABLE_SLOTS_H */
