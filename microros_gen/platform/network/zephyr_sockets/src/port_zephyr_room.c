/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_zephyr_room.h"

#include "microros/lock.h"

enum { AGAIN_MS = 1 };

/* The first that was full: an inquiry has another connection for a moment, and does not wait here. */
static int full_handle = -1;
static bool lacks_memory; /* the connection may count as ready to send meanwhile */

void port_zephyr_room_note(int handle, bool is_full, bool is_memory)
{
  if (is_full) {
    if (full_handle < 0 || full_handle == handle) {
      full_handle = handle;
      lacks_memory = is_memory;
    }
  } else if (full_handle == handle) {
    full_handle = -1;
  } else {
    /* another connection */
  }
}

uint32_t port_zephyr_room_watch(struct zsock_pollfd * end, uint32_t timeout_ms)
{
  uint32_t left_ms = timeout_ms;

  microros_lock();
  if (end->fd >= 0 && end->fd == full_handle) {
    if (!lacks_memory) {
      end->events = ZSOCK_POLLIN | ZSOCK_POLLOUT;
    } else if (left_ms > (uint32_t)AGAIN_MS) {
      left_ms = AGAIN_MS;
    } else {
      /* sooner */
    }
  }
  microros_unlock();
  return left_ms;
}
