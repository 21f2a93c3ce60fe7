/* SPDX-License-Identifier: Apache-2.0 */
/* No wait ends when a connection has room. Internal. */
#ifndef MICROROS_PORT_ZEPHYR_ROOM_H
#define MICROROS_PORT_ZEPHYR_ROOM_H

#include <stdbool.h>
#include <zephyr/net/socket.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Called when the connection has taken all bytes, or not. */
static inline void port_zephyr_room_note(int handle, bool is_full)
{
  (void)handle;
  (void)is_full;
}

/* Called before a wait. */
static inline void port_zephyr_room_watch(const struct zsock_pollfd * end)
{
  (void)end;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_ZEPHYR_ROOM_H */
