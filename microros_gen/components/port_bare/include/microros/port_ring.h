/* SPDX-License-Identifier: Apache-2.0 */
/* What the serial line's interrupt has received and nobody has read yet. One interrupt puts, one task takes. */
#ifndef MICROROS_PORT_RING_H
#define MICROROS_PORT_RING_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* For the interrupt: adds a byte; a full ring counts it as lost. */
void port_ring_put(uint8_t byte);

/* For the interrupt: the hardware lost a byte. */
void port_ring_count_loss(void);

/* Takes at most `capacity` bytes; returns how many. Does not block. */
size_t port_ring_take(uint8_t * buffer, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_RING_H */
