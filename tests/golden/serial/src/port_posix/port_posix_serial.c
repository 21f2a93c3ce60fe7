/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/links.h"
#include "microros/port.h"
#include "microros/port_posix_serial.h"
#include "microros_config.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/types.h>
#include <termios.h>
#include <unistd.h>

/* A line that is in use, and output that the system had no room for: later calls write it. */
typedef struct serial_line_t {
  bool used;
  int descriptor;      /* -1: lost; from then on it is looked for */
  intptr_t lost;       /* its handle while it is lost */
  const char * device; /* of the caller, who keeps it until the line is closed */
  uint32_t baud;
  uint32_t tried_ms; /* when it was lost, or last looked for */
  size_t size;
  uint8_t bytes[MICROROS_SEND_BUFFER];
} serial_line_t;

/* That of the session, one to another agent that is pinged, and those of links with other boards. */
enum { LINES = 2 + (int)MICROROS_LINKS };

/* The handle of the first line while it is lost, of the second one less: no descriptor, so no wait looks at it. */
enum { LOST = -2 };

static serial_line_t lines[LINES];
static int line_wake = -1; /* end of the pipe of port_wait */

/* Returns the handle of a line. */
static intptr_t line_handle(const serial_line_t * line)
{
  return line->descriptor >= 0 ? (intptr_t)line->descriptor : line->lost;
}

/* Returns the line with this handle; NULL if no line has it. */
static serial_line_t * line_of(intptr_t handle)
{
  for (size_t i = 0; i < (size_t)LINES; ++i) {
    if (lines[i].used && line_handle(&lines[i]) == handle) {
      return &lines[i];
    }
  }
  return NULL;
}

/* Returns a line that nobody uses; NULL if all are in use. */
static serial_line_t * line_free(void)
{
  for (size_t i = 0; i < (size_t)LINES; ++i) {
    if (!lines[i].used) {
      lines[i].lost = (intptr_t)LOST - (intptr_t)i;
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

/* Opens the device of a line. */
static bool line_open(serial_line_t * line)
{
  int handle = open(line->device, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);

  if (handle >= 0 && !serial_make_raw(handle, line->baud)) {
    (void)close(handle);
    handle = -1;
  }
  line->descriptor = handle;
  line->size = 0;
  return handle >= 0;
}

bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  serial_line_t * line = line_free();

  serial->handle = -1;
  if (line != NULL) {
    line->device = device;
    line->baud = baud;
    line->used = line_open(line);
    serial->handle = line->used ? line->descriptor : -1;
  }
  return serial->handle >= 0;
}

void port_serial_close(port_serial_t * serial)
{
  serial_line_t * line = line_of(serial->handle);

  if (line != NULL) {
    if (line->descriptor >= 0) {
      (void)close(line->descriptor);
    }
    line->used = false;
  }
  serial->handle = -1;
}

/* Gives the device back, so that it gets the same name when it returns; what waits is cut off anyway. */
static void line_lose(serial_line_t * line)
{
  (void)close(line->descriptor);
  line->descriptor = -1;
  line->size = 0;
  line->tried_ms = port_time_ms();
}

/* Looks for a lost device, not at each call. */
static void line_find(serial_line_t * line)
{
  const uint32_t now = port_time_ms();

  if (now - line->tried_ms >= PORT_POSIX_SERIAL_RETRY_MS) {
    line->tried_ms = now;
    (void)line_open(line); /* otherwise the next time */
  }
}

/* Returns whether a failed call found that the device is gone. */
static bool serial_is_lost(int error)
{
  return error != EAGAIN && error != EINTR;
}

/* Writes as much as the system has room for, and returns the number of bytes. */
static size_t line_write_some(serial_line_t * line, const uint8_t * data, size_t size)
{
  const ssize_t taken = size != 0u ? write(line->descriptor, data, size) : 0;

  if (taken < 0 && serial_is_lost(errno)) {
    line_lose(line);
  }
  return taken > 0 ? (size_t)taken : 0u;
}

static void line_flush(serial_line_t * line)
{
  const size_t taken = line_write_some(line, line->bytes, line->size);

  if (taken != 0u) {
    line->size -= taken;
    (void)memmove(line->bytes, &line->bytes[taken], line->size);
  }
}

/* Returns the line after it has written what the system has room for; NULL: not open, or lost. */
static serial_line_t * line_flushed(port_serial_t * serial)
{
  serial_line_t * line = line_of(serial->handle);

  if (line == NULL) {
    return NULL;
  }
  if (line->descriptor < 0) {
    line_find(line);
  } else {
    line_flush(line);
  }
  serial->handle = line_handle(line);
  return line->descriptor >= 0 ? line : NULL;
}

bool port_posix_serial_waits(int handle)
{
  const serial_line_t * line = handle >= 0 ? line_of(handle) : NULL;

  return line != NULL && line->size != 0u;
}

/* What waits for room in a line asks for waits of 0 ms. A lost line gets none before it is looked for, and room in another one
 * ends a wait: these waits take a millisecond instead of all processor time. */
uint32_t port_posix_serial_left(uint32_t left_ms)
{
  uint32_t left = left_ms;

  for (size_t i = 0; i < (size_t)LINES; ++i) {
    const serial_line_t * line = &lines[i];

    if (line->used && line->descriptor < 0 && left > PORT_POSIX_SERIAL_RETRY_MS) {
      left = PORT_POSIX_SERIAL_RETRY_MS;
    }
    if (line->used && left == 0u && (line->descriptor < 0 || line->size != 0u)) {
      left = 1;
    }
  }
  return left;
}

void port_posix_serial_set_wake(int end)
{
  line_wake = end;
}

size_t port_serial_room(port_serial_t * serial)
{
  const serial_line_t * line = line_flushed(serial);

  return line != NULL ? sizeof(line->bytes) - line->size : 0u;
}

/* A task that waits already looks for room from now on. */
static void line_keep(serial_line_t * line, const uint8_t * data, size_t size)
{
  const char byte = 0;

  if (line->size == 0u && size != 0u && line_wake >= 0) {
    (void)!write(line_wake, &byte, 1); /* a full pipe wakes as well */
  }
  (void)memcpy(&line->bytes[line->size], data, size);
  line->size += size;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  serial_line_t * line = line_flushed(serial);
  size_t taken = 0;

  if (line == NULL || size > sizeof(line->bytes) - line->size) {
    return false;
  }
  if (line->size == 0u) {
    taken = line_write_some(line, data, size);
  }
  serial->handle = line_handle(line);
  if (line->descriptor < 0) {
    return false;
  }
  line_keep(line, &data[taken], size - taken);
  return true;
}

bool port_serial_is_idle(port_serial_t * serial)
{
  const serial_line_t * line = line_flushed(serial);

  return line == NULL || line->size == 0u;
}

/* Returns whether the device has hung up. */
static bool line_has_hung_up(const serial_line_t * line)
{
  struct pollfd end = {.fd = line->descriptor, .events = 0, .revents = 0};

  return poll(&end, 1, 0) > 0;
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  serial_line_t * line = line_flushed(serial);
  const ssize_t size = line != NULL ? read(line->descriptor, buffer, capacity) : 0;

  /* nothing arrived, and the end of a line, look alike */
  if (line != NULL && (size < 0 ? serial_is_lost(errno) : size == 0 && line_has_hung_up(line))) {
    line_lose(line);
    serial->handle = line_handle(line);
  }
  return size > 0 ? (size_t)size : 0u;
}
