/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An executor over a transport of the application: it rests in the read function. Prints how often that was called in a
 * second of nothing, how much of it the processor was busy (ms), and how long a sample had to wait that was sent meanwhile.
 * Arguments: the agent's port; `polls` to make calls without a time-out instead, and print how often they read, what the read
 * function was told to wait for at most (ms), and whether all that was published is acknowledged.
 */
#define _DEFAULT_SOURCE
#include "types.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { VALUES = 50, POLLS = 50000 };

static rclc_support_t support;
static int handle = -1;
static uint16_t port;
static long reads;
static int taken;
static int longest_ms; /* that the read function was told to wait */

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
  longest_ms = timeout > longest_ms ? timeout : longest_ms;
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

static void on_value(const void * message)
{
  (void)message;
  ++taken;
}

static double seconds(clockid_t clock)
{
  struct timespec now;

  (void)clock_gettime(clock, &now);
  return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

/* Publishes, takes and spins without a time-out; the agent has time to answer in between. */
static void poll_only(
  rcl_publisher_t * publisher, rcl_subscription_t * subscription, rclc_executor_t * executor)
{
  std_msgs__msg__Int32 message = {0};
  int acknowledged = 0;

  reads = 0;
  longest_ms = 0;
  for (int i = 0; i < POLLS && (message.data < VALUES || acknowledged == 0); ++i) {
    if (message.data < VALUES && rcl_publish(publisher, &message, NULL) == RCL_RET_OK) {
      ++message.data;
    }
    (void)rcl_take(subscription, &message, NULL, NULL);
    (void)rclc_executor_spin_some(executor, 0);
    acknowledged = rmw_uros_flush(rcl_context_get_rmw_context(&support.context), 0) == RMW_RET_OK ? 1 : 0;
    (void)usleep(100);
  }
  printf("%ld %d %d\n", reads, longest_ms, message.data == VALUES && acknowledged != 0 ? 1 : 0);
}

int main(int argc, char ** argv)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  static rcl_subscription_t subscription;
  static std_msgs__msg__Int32 message;
  double start;
  double busy;

  port = argc > 1 ? (uint16_t)atoi(argv[1]) : 0;
  check(
    rmw_uros_set_custom_transport(false, NULL, my_open, my_close, my_write, my_read) == RMW_RET_OK, "set");
  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK, "init");
  check(rclc_node_init_default(&node, "waits", "", &support) == RCL_RET_OK, "node");
  check(
    rclc_subscription_init_default(
      &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "in") == RCL_RET_OK,
    "subscription");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK, "executor");
  check(
    rclc_executor_add_subscription(&executor, &subscription, &message, on_value, ON_NEW_DATA) == RCL_RET_OK,
    "add");
  (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(200)); /* READ_DATA and its acknowledgement */
  if (argc > 2) {
    check(
      rclc_publisher_init_default(
        &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "out") == RCL_RET_OK,
      "publisher");
    poll_only(&publisher, &subscription, &executor);
    return 0;
  }
  reads = 0;
  busy = seconds(CLOCK_PROCESS_CPUTIME_ID);
  start = seconds(CLOCK_MONOTONIC);
  (void)rclc_executor_spin_some(&executor, RCL_S_TO_NS(1));
  printf(
    "%ld %.0f %.0f\n", reads, (seconds(CLOCK_PROCESS_CPUTIME_ID) - busy) * 1e3,
    (seconds(CLOCK_MONOTONIC) - start) * 1e3);
  (void)fflush(stdout);
  while (taken == 0) {
    (void)rclc_executor_spin_some(&executor, RCL_S_TO_NS(5));
  }
  printf("%.6f\n", seconds(CLOCK_MONOTONIC));
  return 0;
}
