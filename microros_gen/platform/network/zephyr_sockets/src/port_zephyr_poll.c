/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A wait for sockets and for a descriptor that port_wake makes ready. Each end takes one of the kernel's events, and a
 * connection without room another one. An interrupt may not write to a descriptor: it lets
 * the kernel's work queue do that.
 */
#include "microros/links.h"
#include "microros/port.h"
#include "microros/port_zephyr_room.h"
#include "microros/port_zephyr_socket.h"

#include <limits.h>
#include <stddef.h>
#include <zephyr/kernel.h>
#include <zephyr/zvfs/eventfd.h>

#if !defined(CONFIG_ZVFS_EVENTFD)
#error "prj.conf: set CONFIG_ZVFS_EVENTFD=y"
#endif
#if !defined(CONFIG_ZVFS_POLL_MAX) || CONFIG_ZVFS_POLL_MAX < 3
#error "prj.conf: set CONFIG_ZVFS_POLL_MAX to at least 3, and one for each link more"
#endif

enum { WAKE = 0, AGENT = 1, ENDS = 2 };

static void wake_work(struct k_work * work);

static K_WORK_DEFINE(work_of_interrupt, wake_work);
static K_MUTEX_DEFINE(guard);
static int wake_end = -1; /* -1: not open, so that waits end at their time-out */

static int wake_open(void)
{
  int end;

  (void)k_mutex_lock(&guard, K_FOREVER);
  if (wake_end < 0) {
    wake_end = zvfs_eventfd(0, ZVFS_EFD_NONBLOCK);
  }
  end = wake_end;
  (void)k_mutex_unlock(&guard);
  return end;
}

static void wake_work(struct k_work * work)
{
  (void)work;
  port_wake();
}

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  const int wake = wake_open();
  struct zsock_pollfd ends[(int)ENDS + (int)MICROROS_LINKS];
  zvfs_eventfd_t count = 0;
  uint32_t left_ms;

  ends[WAKE].fd = wake;
  ends[AGENT].fd = (int)handle; /* a negative descriptor is passed over */
  for (int i = 0; i < (int)MICROROS_LINKS; ++i) {
    ends[(int)ENDS + i].fd = (int)microros_link_handle(i);
  }
  for (size_t i = 0; i < sizeof(ends) / sizeof(ends[0]); ++i) {
    ends[i].events = ZSOCK_POLLIN;
    ends[i].revents = 0;
  }
  left_ms = port_zephyr_room_watch(&ends[AGENT], timeout_ms);
  (void)zsock_poll(
    ends, (int)(sizeof(ends) / sizeof(ends[0])), left_ms > (uint32_t)INT_MAX ? INT_MAX : (int)left_ms);
  if (wake >= 0) {
    (void)zvfs_eventfd_read(wake, &count); /* an error: nothing has woken it */
  }
}

void port_wake(void)
{
  if (k_is_in_isr()) {
    (void)k_work_submit(&work_of_interrupt); /* it may be on its way already */
  } else {
    const int wake = wake_open();

    if (wake >= 0) {
      (void)zvfs_eventfd_write(wake, 1); /* a full counter wakes as well */
    }
  }
}
