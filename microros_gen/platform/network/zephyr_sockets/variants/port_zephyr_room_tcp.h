/* SPDX-License-Identifier: Apache-2.0 */
/* A wait for a connection that was full ends when it has room. Internal. */
#ifndef MICROROS_PORT_ZEPHYR_ROOM_H
#define MICROROS_PORT_ZEPHYR_ROOM_H

#include <stdbool.h>
#include <stdint.h>
#include <zephyr/net/socket.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Called when the connection has taken all bytes, or not; `is_memory`: for want of the kernel's memory, which no event ends.
 * The caller holds the lock of the library. */
void port_zephyr_room_note(int handle, bool is_full, bool is_memory);

/* Called before a wait, without the lock: what has no room ends it when it has some. Returns how long it may take, at most
 * `timeout_ms`. */
uint32_t port_zephyr_room_watch(struct zsock_pollfd * end, uint32_t timeout_ms);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_ZEPHYR_ROOM_H */
