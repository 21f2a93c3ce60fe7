/* SPDX-License-Identifier: Apache-2.0 */
/* Best-effort messages are sent at once. Internal. */
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
  return false;
}

/* Returns whether none waits. */
static inline bool xrce_output_queue_is_empty(void)
{
  return true;
}

/* Returns whether those that waited at the first call with `mark` have left the queue. */
static inline bool xrce_output_queue_has_passed(const xrce_mark_t * mark)
{
  (void)mark;
  return true;
}

/* Drops the oldest one and returns its submessage, valid until the next reservation; NULL: the queue is empty. */
static inline const uint8_t * xrce_output_queue_drop_oldest(void)
{
  return NULL;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_OUTPUT_QUEUE_H */
