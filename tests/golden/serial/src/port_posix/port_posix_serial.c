/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"
#include "microros/port_posix_serial.h"
#include "microros_config.h"

#include <fcntl.h>
#include <string.h>
#include <sys/types.h>
#include <termios.h>
#include <unistd.h>

/* An open line, and output that the system had no room for: later calls write it. */
typedef struct serial_line_t {
  int handle; /* -1: none */
  size_t size;
  uint8_t bytes[MICROROS_SEND_BUFFER];
} serial_line_t;

enum { LINES = 2 }; /* that of the session, and one to another agent that is pinged */

static serial_line_t lines[LINES] = {{-1, 0, {0}}, {-1, 0, {0}}};

/* Returns the line with this handle, for -1 a free one; NULL if there is no such line. */
static serial_line_t * line_of(int handle)
{
  for (size_t i = 0; i < LINES; ++i) {
    if (lines[i].handle == handle) {
      return &lines[i];
    }
  }
  return NULL;
}

typedef struct serial_speed_t {
  uint32_t baud;
  speed_t speed;
} serial_speed_t;

/* POSIX defines the speeds up to 38400; all current systems have the next three, Linux also the others. */
static const serial_speed_t speeds[] = {
  {1200, B1200},       {2400, B2400},       {4800, B4800},       {9600, B9600},
  {19200, B19200},     {38400, B38400},
#ifdef B230400
  {57600, B57600},     {115200, B115200},   {230400, B230400},
#endif
#ifdef B4000000
  {460800, B460800},   {500000, B500000},   {576000, B576000},   {921600, B921600},
  {1000000, B1000000}, {1152000, B1152000}, {1500000, B1500000}, {2000000, B2000000},
  {2500000, B2500000}, {3000000, B3000000}, {3500000, B3500000}, {4000000, B4000000},
#endif
};

static bool serial_find_speed(uint32_t baud, speed_t * speed)
{
  for (size_t i = 0; i < sizeof(speeds) / sizeof(speeds[0]); ++i) {
    if (speeds[i].baud == baud) {
      *speed = speeds[i].speed;
      return true;
    }
  }
  return false;
}

/* Eight data bits, no parity, one stop bit, no flow control; no byte is changed, and reads do not wait. */
static bool serial_make_raw(int handle, uint32_t baud)
{
  struct termios settings;
  speed_t speed = 0;

  if (!serial_find_speed(baud, &speed) || tcgetattr(handle, &settings) != 0) {
    return false;
  }
  settings.c_iflag &=
    ~(tcflag_t)(BRKINT | ICRNL | IGNBRK | IGNCR | INLCR | INPCK | ISTRIP | IXANY | IXOFF | IXON | PARMRK);
  settings.c_oflag &= ~(tcflag_t)OPOST;
  settings.c_lflag &= ~(tcflag_t)(ECHO | ECHONL | ICANON | IEXTEN | ISIG);
  settings.c_cflag &= ~(tcflag_t)(CSIZE | CSTOPB | PARENB);
  settings.c_cflag |= (tcflag_t)(CLOCAL | CREAD | CS8);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  return cfsetispeed(&settings, speed) == 0 && cfsetospeed(&settings, speed) == 0 &&
         tcsetattr(handle, TCSANOW, &settings) == 0;
}

bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  serial_line_t * line = line_of(-1);
  int handle = line != NULL ? open(device, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC) : -1;

  if (handle >= 0 && !serial_make_raw(handle, baud)) {
    (void)close(handle);
    handle = -1;
  }
  if (line != NULL) {
    line->handle = handle;
    line->size = 0;
  }
  serial->handle = handle;
  return handle >= 0;
}

void port_serial_close(port_serial_t * serial)
{
  const int handle = (int)serial->handle;
  serial_line_t * line = line_of(handle);

  if (handle >= 0 && line != NULL) {
    (void)close(handle);
    line->handle = -1;
  }
  serial->handle = -1;
}

/* Writes as much as the system has room for, and returns the number of bytes. */
static size_t serial_write_some(int handle, const uint8_t * data, size_t size)
{
  const ssize_t taken = size != 0u ? write(handle, data, size) : 0;

  return taken > 0 ? (size_t)taken : 0u; /* no room, or a broken line, which the session detects */
}

static void line_flush(serial_line_t * line)
{
  const size_t taken = serial_write_some(line->handle, line->bytes, line->size);

  if (taken != 0u) {
    line->size -= taken;
    (void)memmove(line->bytes, &line->bytes[taken], line->size);
  }
}

/* Returns the line after it has written what the system has room for; NULL: not open. */
static serial_line_t * line_flushed(const port_serial_t * serial)
{
  serial_line_t * line = serial->handle >= 0 ? line_of((int)serial->handle) : NULL;

  if (line != NULL) {
    line_flush(line);
  }
  return line;
}

bool port_posix_serial_waits(int handle)
{
  const serial_line_t * line = handle >= 0 ? line_of(handle) : NULL;

  return line != NULL && line->size != 0u;
}

size_t port_serial_room(port_serial_t * serial)
{
  const serial_line_t * line = line_flushed(serial);

  return line != NULL ? sizeof(line->bytes) - line->size : 0u;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  serial_line_t * line = line_flushed(serial);
  size_t taken = 0;

  if (line == NULL || size > sizeof(line->bytes) - line->size) {
    return false;
  }
  if (line->size == 0u) {
    taken = serial_write_some(line->handle, data, size);
  }
  (void)memcpy(&line->bytes[line->size], &data[taken], size - taken);
  line->size += size - taken;
  return true;
}

bool port_serial_is_idle(port_serial_t * serial)
{
  const serial_line_t * line = line_flushed(serial);

  return line == NULL || line->size == 0u;
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  ssize_t size;

  (void)line_flushed(serial);
  size = read((int)serial->handle, buffer, capacity);
  return size > 0 ? (size_t)size : 0u; /* nothing arrived, or a broken line */
}
