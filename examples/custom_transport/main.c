/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Four functions of the application carry the bytes: here over a serial line of POSIX, on a board over its UART, USB or radio.
 * The line keeps no messages apart, so the library frames them. Argument: the device; with `microros-gen agent pty`,
 * the one that the agent prints.
 */
#define _POSIX_C_SOURCE 200809L

#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rclc/sleep.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>
#include <uxr/client/transport.h>

#include <fcntl.h>
#include <inttypes.h>
#include <poll.h>
#include <unistd.h>

typedef struct {
  const char * device;
  int handle;
} line_t;

static bool line_open(struct uxrCustomTransport * transport)
{
  line_t * line = transport->args;

  line->handle = open(line->device, O_RDWR | O_NOCTTY | O_NONBLOCK);
  return line->handle >= 0;
}

static bool line_close(struct uxrCustomTransport * transport)
{
  const line_t * line = transport->args;

  return close(line->handle) == 0;
}

static size_t line_write(
  struct uxrCustomTransport * transport, const uint8_t * bytes, size_t size, uint8_t * error)
{
  const line_t * line = transport->args;
  const ssize_t written = write(line->handle, bytes, size);

  *error = written < 0;
  return written < 0 ? 0 : (size_t)written;
}

static size_t line_read(
  struct uxrCustomTransport * transport, uint8_t * bytes, size_t size, int timeout_ms, uint8_t * error)
{
  const line_t * line = transport->args;
  struct pollfd input = {line->handle, POLLIN, 0};
  ssize_t received = 0;

  if (poll(&input, 1, timeout_ms) > 0) {
    received = read(line->handle, bytes, size);
  }
  *error = received < 0;
  return received < 0 ? 0 : (size_t)received;
}

int main(int argc, char ** argv)
{
  static line_t line;
  static rclc_support_t support;
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  static std_msgs__msg__Int32 count;
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  line.device = argc > 1 ? argv[1] : "/dev/ttyUSB0";
  example_check(
    rmw_uros_set_custom_transport(true, &line, line_open, line_close, line_write, line_read), "transport");
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "own_line", "", &support), "node");
  example_check(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "over_own_line"),
    "publisher");
  while (example_runs()) {
    if (example_tell(rcl_publish(&publisher, &count, NULL), "publish")) {
      ++count.data;
    }
    rclc_sleep_ms(50);
  }
  example_check(rcl_publisher_fini(&publisher, &node), "end of the publisher");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
