/* SPDX-License-Identifier: Apache-2.0 */
/* A pipe wakes the waiting thread: any thread may write to it, and a signal handler after the first wait. */
#define _POSIX_C_SOURCE 200809L
#include "microros/links.h"
#include "microros/port.h"
#include "microros/port_posix_room.h"

#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <stddef.h>
#include <sys/types.h>
#include <unistd.h>

enum { OUT = 0, IN = 1, ENDS = 2 };

static int wake_pipe[ENDS] = {-1, -1};

static bool wake_make_end(int end)
{
  const int flags = fcntl(end, F_GETFL);
  const unsigned int wanted = (unsigned int)flags | (unsigned int)O_NONBLOCK;

  return flags >= 0 && fcntl(end, F_SETFL, (int)wanted) >= 0 && fcntl(end, F_SETFD, FD_CLOEXEC) >= 0;
}

/* Without a pipe, waits end at their time-out. */
static void wake_open(void)
{
  int ends[ENDS];

  if (pipe(ends) != 0) {
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

/* Returns one end of the pipe, which the first call opens; -1 on failure. */
static int wake_end(int end)
{
  static pthread_once_t once = PTHREAD_ONCE_INIT;

  (void)pthread_once(&once, wake_open);
  return wake_pipe[end];
}

static void wake_drain(int end)
{
  char bytes[16];
  ssize_t size;

  do {
    size = read(end, bytes, sizeof(bytes));
  } while (size == (ssize_t)sizeof(bytes));
}

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  const int wake = wake_end(OUT);
  struct pollfd ends[(int)ENDS + (int)MICROROS_LINKS];
  const uint32_t left_ms = timeout_ms;

  ends[0].fd = wake;
  ends[1].fd = (int)handle; /* poll ignores negative descriptors */
  for (int i = 0; i < (int)MICROROS_LINKS; ++i) {
    ends[(int)ENDS + i].fd = (int)microros_link_handle(i);
  }
  for (size_t i = 0; i < sizeof(ends) / sizeof(ends[0]); ++i) {
    ends[i].events = POLLIN;
  }
  port_posix_room_watch(&ends[1]);
  /* a signal may end it early */
  (void)poll(ends, sizeof(ends) / sizeof(ends[0]), left_ms > (uint32_t)INT_MAX ? INT_MAX : (int)left_ms);
  if (wake >= 0) {
    wake_drain(wake);
  }
}

void port_wake(void)
{
  const int wake = wake_end(IN);
  const char byte = 0;

  if (wake >= 0) {
    (void)!write(wake, &byte, 1); /* a full pipe wakes as well */
  }
}
