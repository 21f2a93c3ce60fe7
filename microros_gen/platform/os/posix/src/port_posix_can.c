/* SPDX-License-Identifier: Apache-2.0 */
/*
 * CAN FD by SocketCAN (Linux): a device is the name of a network interface such as can0 or vcan0. "unix:PATH" is a
 * socket (SOCK_SEQPACKET) of a program that plays the bus: it carries the same records, struct canfd_frame. */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_can.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/un.h>
#include <unistd.h>

#define PLAYED "unix:"

/* The handle of a device that is gone: no descriptor, so no wait looks at it. */
enum { LOST = -2 };

static bool can_connect(int handle, const char * path)
{
  struct sockaddr_un address;

  (void)memset(&address, 0, sizeof(address));
  address.sun_family = AF_UNIX;
  if (strlen(path) >= sizeof(address.sun_path)) {
    return false;
  }
  (void)memcpy(address.sun_path, path, strlen(path));
  return connect(handle, (const struct sockaddr *)&address, sizeof(address)) == 0;
}

/* The kernel then drops all other frames, so that they wake nobody. */
static bool can_filter(int handle, uint32_t id)
{
  const struct can_filter filter = {id | CAN_EFF_FLAG, CAN_EFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG};
  const int on = 1;

  return setsockopt(handle, SOL_CAN_RAW, CAN_RAW_FILTER, &filter, sizeof(filter)) == 0 &&
         setsockopt(handle, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof(on)) == 0;
}

static bool can_bind(int handle, const char * device, uint32_t id)
{
  const unsigned int interface_ = if_nametoindex(device);
  struct sockaddr_can address;

  (void)memset(&address, 0, sizeof(address));
  address.can_family = AF_CAN;
  address.can_ifindex = (int)interface_;
  return interface_ != 0u && can_filter(handle, id) &&
         bind(handle, (const struct sockaddr *)&address, sizeof(address)) == 0;
}

static bool can_begin(int handle, const char * device, uint32_t id, bool played)
{
  const int flags = fcntl(handle, F_GETFL);

  if (flags < 0 || fcntl(handle, F_SETFL, flags | O_NONBLOCK) < 0 || fcntl(handle, F_SETFD, FD_CLOEXEC) < 0) {
    return false;
  }
  return played ? can_connect(handle, &device[sizeof(PLAYED) - 1u]) : can_bind(handle, device, id);
}

bool port_can_open_link(port_can_t * can, const char * device, uint32_t sent, uint32_t received)
{
  const bool played = strncmp(device, PLAYED, sizeof(PLAYED) - 1u) == 0;
  int handle = played ? socket(AF_UNIX, SOCK_SEQPACKET, 0) : socket(AF_CAN, SOCK_RAW, CAN_RAW);

  if (handle >= 0 && !can_begin(handle, device, received, played)) {
    (void)close(handle);
    handle = -1;
  }
  can->handle = handle;
  can->id = sent;
  can->received = received;
  return handle >= 0;
}

bool port_can_open(port_can_t * can, const char * device, uint32_t id)
{
  return port_can_open_link(can, device, id, id);
}

void port_can_close(port_can_t * can)
{
  if (can->handle >= 0) {
    (void)close((int)can->handle);
  }
  can->handle = -1;
}

/* Gives up a device that was removed; one that is only down works again by itself. `result` is that of a failed call. */
static void can_look(port_can_t * can, ssize_t result)
{
  const bool lost = result == 0 || errno == ENODEV || errno == ENXIO || errno == EPIPE || errno == ECONNRESET;

  if (can->handle >= 0 && lost) {
    port_can_close(can);
    can->handle = LOST;
  }
}

bool port_can_send(port_can_t * can, const uint8_t * data, size_t size)
{
  struct canfd_frame frame;
  ssize_t sent;

  (void)memset(&frame, 0, sizeof(frame));
  frame.can_id = can->id | CAN_EFF_FLAG;
  frame.len = (uint8_t)size;
  (void)memcpy(frame.data, data, size);
  sent = send((int)can->handle, &frame, sizeof(frame), MSG_NOSIGNAL);
  if (sent < 0) {
    can_look(can, sent);
  }
  return sent == (ssize_t)sizeof(frame);
}

/* A classic frame has the same members with less data. */
static bool can_is_whole(const struct canfd_frame * frame, ssize_t size)
{
  return (size == (ssize_t)CANFD_MTU && frame->len <= CANFD_MAX_DLEN) ||
         (size == (ssize_t)CAN_MTU && frame->len <= CAN_MAX_DLEN);
}

size_t port_can_receive(port_can_t * can, uint8_t * data)
{
  struct canfd_frame frame;
  ssize_t size;

  do {
    (void)memset(&frame, 0, sizeof(frame));
    size = recv((int)can->handle, &frame, sizeof(frame), 0);
    if (frame.can_id == (can->received | CAN_EFF_FLAG) && frame.len != 0u && can_is_whole(&frame, size)) {
      (void)memcpy(data, frame.data, frame.len);
      return frame.len;
    }
  } while (size > 0);
  can_look(can, size); /* a played bus that has ended returns 0 */
  return 0;            /* nothing arrived, or the interface is down, which the session detects */
}
