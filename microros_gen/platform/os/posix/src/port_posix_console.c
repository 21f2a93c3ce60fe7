/* SPDX-License-Identifier: Apache-2.0 */
/* Log lines are written to standard error, as in ROS 2. */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_console.h"

#include <poll.h>
#include <unistd.h>

bool port_console_write(const char * line, size_t size)
{
  struct pollfd console = {.fd = STDERR_FILENO, .events = POLLOUT};

  /* A pipe that is ready takes PIPE_BUF bytes, more than a line has, without blocking. */
  if (poll(&console, 1, 0) != 1 || (console.revents & POLLOUT) == 0) {
    return false;
  }
  return write(STDERR_FILENO, line, size) == (ssize_t)size;
}
