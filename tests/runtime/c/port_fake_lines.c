/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The other transports of the port whose network is in the hands of the test: a connection, the one serial line of a board, or
 * a line or a medium of packets after functions of the application; and a group for multicast. A line is one: who closes it
 * closes it for all.
 */
#include "port_fake.h"

#include "microros/port.h"
#include "microros_config.h"
#ifdef RMW_UXRCE_TRANSPORT_CUSTOM
#include <rcutils/error_handling.h>
#include <rmw_microros/rmw_microros.h>
#endif

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_HANDLE = 7, LONGEST_WAIT_MS = 10 };

static bool is_open;

static bool line_open(void)
{
  if (is_open) {
    fprintf(stderr, "a line was opened twice\n");
    abort();
  }
  is_open = fake_open("line", 0);
  return is_open;
}

static void line_close(void)
{
  if (!is_open) {
    fprintf(stderr, "a line was closed that is not open\n");
    abort();
  }
  is_open = false;
  fake_close();
}

static bool line_write(const uint8_t * data, size_t size)
{
  return is_open && fake_send(data, size);
}

/* Returns the bytes that there are, `capacity` at most; of a medium of packets, those of one. */
static size_t line_read(uint8_t * buffer, size_t capacity)
{
  return is_open ? fake_read(buffer, capacity) : 0u;
}

bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud)
{
  (void)device;
  (void)baud;
  serial->handle = LINE_HANDLE;
  return line_open();
}

void port_serial_close(port_serial_t * serial)
{
  if (serial->handle != LINE_HANDLE) {
    abort();
  }
  line_close();
}

size_t port_serial_room(port_serial_t * serial)
{
  (void)serial;
  return SIZE_MAX;
}

bool port_serial_is_idle(port_serial_t * serial)
{
  (void)serial;
  return true;
}

bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size)
{
  (void)serial;
  return line_write(data, size);
}

size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity)
{
  (void)serial;
  return line_read(buffer, capacity);
}

bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port)
{
  tcp->handle = LINE_HANDLE;
  return fake_open(host, port);
}

void port_tcp_close(port_tcp_t * tcp)
{
  if (tcp->handle != LINE_HANDLE) {
    abort();
  }
  fake_close();
}

int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size)
{
  (void)tcp;
  return fake_send(data, size) ? (int32_t)size : 0;
}

int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity)
{
  (void)tcp;
  return (int32_t)fake_read(buffer, capacity);
}

bool port_multicast_open(port_multicast_t * multicast)
{
  fake_check_lock();
  multicast->handle = 1;
  return true;
}

void port_multicast_close(port_multicast_t * multicast)
{
  fake_check_lock();
  multicast->handle = -1;
}

bool port_multicast_send(
  port_multicast_t * multicast, const char * group, uint16_t port, const uint8_t * data, size_t size)
{
  (void)multicast;
  fake_check_lock();
  printf("group %s %u ", group, (unsigned)port);
  for (size_t i = 0; i < size; ++i) {
    printf("%02x", data[i]);
  }
  printf("\n");
  return true;
}

size_t port_multicast_receive(
  port_multicast_t * multicast, uint8_t * buffer, size_t capacity, uint8_t * sender)
{
  static const uint8_t loopback[PORT_MULTICAST_ADDRESS] = {127, 0, 0, 1};

  (void)multicast;
  fake_check_lock();
  (void)memcpy(sender, loopback, sizeof(loopback));
  return fake_group_read(buffer, capacity);
}

#ifdef RMW_UXRCE_TRANSPORT_CUSTOM
static int line; /* what the functions are given */

static bool custom_open(struct uxrCustomTransport * transport)
{
  return transport->args == &line && line_open();
}

static bool custom_close(struct uxrCustomTransport * transport)
{
  line_close();
  return transport->args == &line;
}

static size_t custom_write(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t size, uint8_t * error)
{
  *error = 0;
  return transport->args == &line && line_write(buffer, size) ? size : 0u;
}

static size_t custom_read(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t size, int timeout, uint8_t * error)
{
  *error = 0;
  if (timeout < 0 || timeout > LONGEST_WAIT_MS) {
    fprintf(stderr, "the read function is to wait for %d ms\n", timeout);
    abort();
  }
  return transport->args == &line ? line_read(buffer, size) : 0u;
}

/* As an application does before it calls anything else. */
__attribute__((constructor)) static void choose(void)
{
  for (int framing = 0; framing < 2; ++framing) {
    (void)rmw_uros_set_custom_transport(
      framing != 0, &line, custom_open, custom_close, custom_write, custom_read);
  }
  rcutils_reset_error();
}
#endif
