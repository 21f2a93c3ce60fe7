/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The log writer `ring`: keeps the last lines, encoded rcl_interfaces/msg/Log, in memory that survives a reset. The oldest
 * give way to new ones. Under the lock of the session. Internal.
 */
#ifndef MICROROS_RCUTILS_RING_H
#define MICROROS_RCUTILS_RING_H

#include <stdbool.h>
#include <stdint.h>

/* Returns whether lines of this severity are kept. */
bool microros_ring_takes(int severity);

/* Keeps a line of `size` bytes. */
void microros_ring_put(const uint8_t * body, uint32_t size);

#endif /* MICROROS_RCUTILS_RING_H */
