/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How often one call of the library uses the functions of a transport of packets. Publishes a reliable message of many
 * fragments, then small ones while somebody else reads, and prints for these calls: the most fragments of one call, the reads
 * of the small ones, and whether all was acknowledged in the end. Argument: the agent's port.
 */
#define _DEFAULT_SOURCE
#include "microros/port.h"
#include "types.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum {
  FRAGMENT = 0x0d,
  WRITE_DATA = 0x07,
  SUBMESSAGE_AT = 4,
  BODY = 900,
  CALLS = 2000,
  SMALL = 3,
  FLUSH_MS = 20000
};

static int handle = -1;
static uint16_t port;
static unsigned fragments; /* of this call */
static unsigned reads;

static bool my_open(struct uxrCustomTransport * transport)
{
  struct sockaddr_in address;

  (void)transport;
  memset(&address, 0, sizeof(address));
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  handle = socket(AF_INET, SOCK_DGRAM, 0);
  return connect(handle, (struct sockaddr *)&address, sizeof(address)) == 0;
}

static bool my_close(struct uxrCustomTransport * transport)
{
  (void)transport;
  return close(handle) == 0;
}

static size_t my_write(struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  const ssize_t sent = send(handle, buf, len, 0);

  (void)transport;
  if (buf[SUBMESSAGE_AT] == FRAGMENT || buf[SUBMESSAGE_AT] == WRITE_DATA) {
    ++fragments;
  }
  *err = sent < 0 ? 1 : 0;
  return sent < 0 ? 0 : (size_t)sent;
}

static size_t my_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  struct pollfd end = {handle, POLLIN, 0};
  ssize_t size = 0;

  (void)transport;
  ++reads;
  if (poll(&end, 1, timeout) > 0) {
    size = recv(handle, buf, len, 0);
  }
  *err = size <= 0 ? 1 : 0;
  return size > 0 ? (size_t)size : 0;
}

static void check(bool good, const char * what)
{
  if (!good) {
    (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
    exit(1);
  }
}

/* Returns the most fragments that one call sent, this one or those that follow. */
static unsigned publish_large(const rcl_publisher_t * publisher, rmw_context_t * context)
{
  static uint8_t bytes[4 + BODY] = {0, 1, 0, 0};
  rmw_serialized_message_t message = rmw_get_zero_initialized_serialized_message();
  unsigned most;

  for (size_t i = 0; i < BODY; ++i) {
    bytes[4 + i] = (uint8_t)(i * 7u);
  }
  message.buffer = bytes;
  message.buffer_length = sizeof(bytes);
  message.buffer_capacity = sizeof(bytes);
  fragments = 0;
  check(rcl_publish_serialized_message(publisher, &message, NULL) == RCL_RET_OK, "large");
  most = fragments;
  for (int i = 0; i < CALLS; ++i) {
    fragments = 0;
    (void)rmw_uros_spin_once(context);
    most = fragments > most ? fragments : most;
  }
  return most;
}

int main(int argc, char ** argv)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  static rclc_support_t support;
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  const std_msgs__msg__Int32 small = {5};
  rmw_context_t * context;
  unsigned most;
  uint32_t start_ms;

  port = argc > 1 ? (uint16_t)atoi(argv[1]) : 0;
  check(
    rmw_uros_set_custom_transport(false, NULL, my_open, my_close, my_write, my_read) == RMW_RET_OK, "set");
  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK, "init");
  check(rclc_node_init_default(&node, "turns", "", &support) == RCL_RET_OK, "node");
  check(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "chatter") == RCL_RET_OK,
    "publisher");
  context = rcl_context_get_rmw_context(&support.context);
  most = publish_large(&publisher, context);
  check(rmw_uros_flush(context, FLUSH_MS) == RMW_RET_OK, "flush");
  do { /* again where the machine was so busy that a publish had to read for itself */
    check(rmw_uros_flush(context, FLUSH_MS) == RMW_RET_OK, "flush");
    (void)rmw_uros_spin_once(context);
    start_ms = port_time_ms();
    reads = 0;
    for (int i = 0; i < SMALL; ++i) {
      check(rcl_publish(&publisher, &small, NULL) == RCL_RET_OK, "small");
    }
  } while (port_time_ms() - start_ms > 100u);
  printf("%u %u\n", most, reads);
  check(rmw_uros_flush(context, FLUSH_MS) == RMW_RET_OK, "flush");
  return 0;
}
