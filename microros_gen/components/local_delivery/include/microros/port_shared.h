/* SPDX-License-Identifier: Apache-2.0 */
/* Memory that the images of one chip share. A platform provides it; a board has it in the application. */
#ifndef MICROROS_PORT_SHARED_H
#define MICROROS_PORT_SHARED_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Returns the memory, of at least `bytes` bytes, aligned to 4, which all images see at any address; the same one in each call. It
 * belongs to the platform, and is not cached. NULL: the platform has no such memory. Its first content may be anything; it stays
 * while one of the images restarts. Called with the lock held, after NULL again with the next rclc_support_init. */
uint32_t * port_shared_region(size_t bytes);

/* A memory barrier, for the compiler as well: other images see earlier writes before later ones, and earlier reads and writes
 * precede later ones. Called a few times for each message. */
void port_shared_barrier(void);

/* Tells the other images that a message was written: an interrupt there calls port_wake. It may do nothing: an image looks
 * every millisecond, too. Called with the lock held. */
void port_shared_notify(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_SHARED_H */
