/* SPDX-License-Identifier: Apache-2.0 */
/* Best-effort messages wait until a task sends them: a queue of the best-effort stream. Internal. */
#ifndef MICROROS_XRCE_OUTPUT_QUEUE_H
#define MICROROS_XRCE_OUTPUT_QUEUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_mark.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether best-effort messages wait in a queue. */
static inline bool xrce_output_queue_exists(void)
{
  return true;
}

/* Returns whether none waits. */
bool xrce_output_queue_is_empty(void);

/* Returns whether those that waited at the first call with `mark` have left the queue. */
bool xrce_output_queue_has_passed(xrce_mark_t * mark);

/* Drops the oldest one and returns its submessage, valid until the next reservation; NULL: the queue is empty. */
const uint8_t * xrce_output_queue_drop_oldest(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_OUTPUT_QUEUE_H */
