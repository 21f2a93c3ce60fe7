/* SPDX-License-Identifier: Apache-2.0 */
/* No wait ends when a connection has room. Internal. */
#ifndef MICROROS_PORT_ZEPHYR_ROOM_H
#define MICROROS_PORT_ZEPHYR_ROOM_H

#include <stdbool.h>
#include <stdint.h>
#include <zephyr/net/socket.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Called when the connection has taken all bytes, or not. */
static inline void port_zephyr_room_note(int handle, bool is_full, bool is_memory)
{
  (void)handle;
  (void)is_full;
  (void)is_memory;
}

/* Called before a wait. Returns how long it may take, at most `timeout_ms`. */
static inline uint32_t port_zephyr_room_watch(const struct zsock_pollfd * end, uint32_t timeout_ms)
{
  (void)end;
  return timeout_ms;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_ZEPHYR_ROOM_H */
