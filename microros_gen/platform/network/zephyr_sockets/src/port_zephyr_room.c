/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port_zephyr_room.h"

#include "microros/lock.h"

static int full_handle = -1; /* the session has one connection at a time */

void port_zephyr_room_note(int handle, bool is_full)
{
  if (is_full) {
    full_handle = handle;
  } else if (full_handle == handle) {
    full_handle = -1;
  } else {
    /* another connection */
  }
}

void port_zephyr_room_watch(struct zsock_pollfd * end)
{
  microros_lock();
  if (end->fd >= 0 && end->fd == full_handle) {
    end->events = ZSOCK_POLLIN | ZSOCK_POLLOUT;
  }
  microros_unlock();
}
