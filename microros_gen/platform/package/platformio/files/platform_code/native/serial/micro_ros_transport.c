/* SPDX-License-Identifier: Apache-2.0 */
#define _DEFAULT_SOURCE
#include "micro_ros_platformio.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

static int line = -1;

bool platformio_transport_open(struct uxrCustomTransport * transport)
{
  struct termios settings;

  line = open((const char *)transport->args, O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (line >= 0 && tcgetattr(line, &settings) == 0) {
    cfmakeraw(&settings);
    (void)tcsetattr(line, TCSANOW, &settings);
  }
  return line >= 0;
}

bool platformio_transport_close(struct uxrCustomTransport * transport)
{
  const bool is_closed = line < 0 || close(line) == 0;

  (void)transport;
  line = -1;
  return is_closed;
}

/* Accepts what the line has room for. */
size_t platformio_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const ssize_t sent = write(line, buf, len);

  (void)transport;
  *err = sent < 0 && errno != EAGAIN ? 1 : 0;
  return sent < 0 ? 0u : (size_t)sent;
}

size_t platformio_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  struct pollfd waiting = {line, POLLIN, 0};
  ssize_t size = 0;

  (void)transport;
  if (poll(&waiting, 1, timeout) > 0) {
    size = read(line, buf, len);
  }
  *err = size < 0 && errno != EAGAIN ? 1 : 0;
  return size < 0 ? 0u : (size_t)size;
}
