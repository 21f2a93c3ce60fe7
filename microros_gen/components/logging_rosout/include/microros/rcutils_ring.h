/* SPDX-License-Identifier: Apache-2.0 */
/* Without the log writer `ring` (component logging_ring): keeps nothing. */
#ifndef MICROROS_RCUTILS_RING_H
#define MICROROS_RCUTILS_RING_H

#include <stdbool.h>
#include <stdint.h>

static inline bool microros_ring_takes(int severity)
{
  (void)severity;
  return false;
}

static inline void microros_ring_put(const uint8_t * body, uint32_t size)
{
  (void)body;
  (void)size;
}

#endif /* MICROROS_RCUTILS_RING_H */
