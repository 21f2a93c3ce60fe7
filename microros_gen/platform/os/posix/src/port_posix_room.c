/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_posix_room.h"

#include "microros/lock.h"

/* The first that was full: an inquiry has another connection for a moment, and does not wait here. */
static int full_handle = -1;

void port_posix_room_note(int handle, bool is_full)
{
  if (is_full) {
    if (full_handle < 0 || full_handle == handle) {
      full_handle = handle;
    }
  } else if (full_handle == handle) {
    full_handle = -1;
  } else {
    /* another connection */
  }
}

void port_posix_room_watch(struct pollfd * end)
{
  microros_lock();
  if (end->fd >= 0 && end->fd == full_handle) {
    end->events = POLLIN | POLLOUT;
  }
  microros_unlock();
}
