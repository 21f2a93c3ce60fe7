/* SPDX-License-Identifier: Apache-2.0 */
/* A pipe wakes who waits: writing to it is allowed in every thread and in a signal handler. */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <stddef.h>
#include <sys/types.h>
#include <unistd.h>

enum { OUT = 0, IN = 1, ENDS = 2 };

static volatile int wake_pipe[ENDS] = {-1, -1};
static volatile bool wake_pending;

static bool wake_make_end(int end)
{
  const int flags = fcntl(end, F_GETFL);

  return flags >= 0 && fcntl(end, F_SETFL, flags | O_NONBLOCK) >= 0 && fcntl(end, F_SETFD, FD_CLOEXEC) >= 0;
}

/* Without a pipe, waits end by their time-out. */
static void wake_open(void)
{
  int ends[ENDS];

  if (wake_pipe[OUT] >= 0 || pipe(ends) != 0) {
    return;
  }
  if (!wake_make_end(ends[OUT]) || !wake_make_end(ends[IN])) {
    (void)close(ends[OUT]);
    (void)close(ends[IN]);
    return;
  }
  wake_pipe[OUT] = ends[OUT];
  wake_pipe[IN] = ends[IN];
}

static void wake_drain(void)
{
  char bytes[16];
  ssize_t size;

  do {
    size = read(wake_pipe[OUT], bytes, sizeof(bytes));
  } while (size == (ssize_t)sizeof(bytes));
}

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  const int most_ms = timeout_ms > (uint32_t)INT_MAX ? INT_MAX : (int)timeout_ms;
  struct pollfd ends[] = {{-1, POLLIN, 0}, {(int)handle, POLLIN, 0}}; /* poll leaves out what is negative */

  wake_open();
  ends[0].fd = wake_pipe[OUT];
  if (!wake_pending) {
    (void)poll(ends, sizeof(ends) / sizeof(ends[0]), most_ms); /* a signal ends it early, as may be */
  }
  wake_pending = false;
  if (wake_pipe[OUT] >= 0) {
    wake_drain();
  }
}

void port_wake(void)
{
  const char byte = 0;

  wake_pending = true;
  if (wake_pipe[IN] >= 0) {
    (void)!write(wake_pipe[IN], &byte, 1); /* a full pipe wakes as well */
  }
}
