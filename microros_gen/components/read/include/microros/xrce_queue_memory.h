/* SPDX-License-Identifier: Apache-2.0 */
/* Memory of the queues. Only their own sources and what retains it during a sleep include this. */
#ifndef MICROROS_XRCE_QUEUE_MEMORY_H
#define MICROROS_XRCE_QUEUE_MEMORY_H

#include <stdint.h>

#include "microros/xrce_read.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { XRCE_QUEUE_WORDS = (MICROROS_QUEUES_SIZE + 3u) / 4u };

/* The samples of the only client's queues. They are not in the client, so that a changed limit or depth leaves all other
 * sources as they are. Each sample begins at a multiple of four bytes. */
extern xrce_slot_t xrce_queue_slots[MICROROS_QUEUE_SLOTS];
extern uint32_t xrce_queue_words[XRCE_QUEUE_WORDS];

/* Returns the byte of the queues at `offset`. */
static inline uint8_t * xrce_queue_at(uint32_t offset)
{
  return &((uint8_t *)xrce_queue_words)[offset];
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_QUEUE_MEMORY_H */
