/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An application with its own transport, written as those for micro-ROS are: functions over a socket or a
 * pseudo-terminal, which return -1 for "nothing" as drivers do. Arguments: udp PORT | line PATH | none at all, for a
 * user who forgot to set one.
 */
#define _DEFAULT_SOURCE
#include <uxr/client/transport.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <rmw_microxrcedds_c/config.h>

#include "types.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#ifndef RMW_UXRCE_TRANSPORT_CUSTOM
#error micro-ROS transports misconfigured
#endif

enum { VALUES = 100, TRIES = 2000 };

typedef struct transport_params_t {
  const char * where;
  struct pollfd poll_fd;
  int opened;
} transport_params_t;

static transport_params_t params;

static bool udp_open(struct uxrCustomTransport * transport)
{
  transport_params_t * p = (transport_params_t *)transport->args;
  struct sockaddr_in address;

  memset(&address, 0, sizeof(address));
  address.sin_family = AF_INET;
  address.sin_port = htons((uint16_t)atoi(p->where));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  p->poll_fd.fd = socket(AF_INET, SOCK_DGRAM, IPPROTO_UDP);
  p->poll_fd.events = POLLIN;
  ++p->opened;
  return p->poll_fd.fd >= 0 && connect(p->poll_fd.fd, (struct sockaddr *)&address, sizeof(address)) == 0;
}

static bool line_open(struct uxrCustomTransport * transport)
{
  transport_params_t * p = (transport_params_t *)transport->args;
  struct termios settings;

  p->poll_fd.fd = open(p->where, O_RDWR | O_NOCTTY);
  p->poll_fd.events = POLLIN;
  ++p->opened;
  if (p->poll_fd.fd < 0 || tcgetattr(p->poll_fd.fd, &settings) != 0) {
    return false;
  }
  cfmakeraw(&settings);
  return tcsetattr(p->poll_fd.fd, TCSANOW, &settings) == 0;
}

static bool my_close(struct uxrCustomTransport * transport)
{
  transport_params_t * p = (transport_params_t *)transport->args;

  return close(p->poll_fd.fd) == 0;
}

static size_t my_write(struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err)
{
  transport_params_t * p = (transport_params_t *)transport->args;
  ssize_t sent = write(p->poll_fd.fd, buf, len);

  *err = sent < 0 ? 1 : 0;
  return sent < 0 ? 0 : (size_t)sent;
}

static size_t my_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err)
{
  transport_params_t * p = (transport_params_t *)transport->args;
  ssize_t size = -1;

  if ((timeout == 0) != transport->framing) {
    abort(); /* messages are waited for, bytes are not */
  }
  if (poll(&p->poll_fd, 1, timeout) > 0) {
    size = read(p->poll_fd.fd, buf, len);
  }
  *err = size < 0 ? 1 : 0;
  return (size_t)size; /* as a driver does that returns -1 */
}

static int fail(int code)
{
  printf("%s\n", rcl_get_error_string().str);
  return code;
}

static rmw_ret_t set_transport(int argc, char ** argv)
{
  const bool line = argc > 1 && strcmp(argv[1], "line") == 0;

  if (argc < 3) {
    return RMW_RET_OK;
  }
  params.where = argv[2];
  return rmw_uros_set_custom_transport(
    line, (void *)&params, line ? line_open : udp_open, my_close, my_write, my_read);
}

int main(int argc, char ** argv)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  std_msgs__msg__Int32 message = {0};
  rclc_support_t support;
  rcl_node_t node;
  rcl_publisher_t publisher;
  int tries = 0;

  if (
    rmw_uros_set_custom_transport(true, NULL, NULL, my_close, my_write, my_read) !=
    RMW_RET_INVALID_ARGUMENT) {
    return fail(6);
  }
  if (set_transport(argc, argv) != RMW_RET_OK) {
    return fail(7);
  }
  memset(&support, 0, sizeof(support));
  if (argc > 2 && rmw_uros_ping_agent(1000, 2) != RMW_RET_OK) {
    return fail(8);
  }
  if (rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK) {
    return fail(2);
  }
  if (
    rclc_node_init_default(&node, "talker", "", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "chatter") != RCL_RET_OK) {
    return fail(3);
  }
  while (message.data < VALUES && tries < TRIES) {
    if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
      ++message.data;
    } else {
      ++tries;
    }
    rclc_sleep_ms(2);
  }
  if (tries == TRIES || rmw_uros_flush(rcl_context_get_rmw_context(&support.context), 3000) != RMW_RET_OK) {
    return fail(4);
  }
  if (
    rcl_publisher_fini(&publisher, &node) != RCL_RET_OK || rcl_node_fini(&node) != RCL_RET_OK ||
    rclc_support_fini(&support) != RCL_RET_OK) {
    return fail(5);
  }
  return params.opened == 2 ? 0 : fail(9); /* the ping's and the session's */
}
