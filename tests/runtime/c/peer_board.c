/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A board of tests/runtime/test_peer.py: publishes /OWN/best and /OWN/sure, subscribes to /OTHER/best and /OTHER/sure.
 * Takes commands by lines, and answers each with lines and `ret CODE ERROR`:
 *   publish TOPIC VALUE    TOPIC 0: best, 1: sure
 *   spin MS                prints `got TOPIC VALUE` for each message
 *   rest MS                waits once, at most so long; prints `got` as well, and `times COUNT`: how often the time
 *                          was read
 *   reconnects             prints `reconnects COUNT`
 *   dropped                prints `dropped COUNT`
 *   pass MS                lets time pass
 *   open TOPIC             with LATE: opens the subscription
 *   close TOPIC            closes it
 *   numbers N              all streams of all links continue with message N, as after as many messages
 *   serialized TOPIC SIZE  publishes so many bytes of CDR
 *   meanwhile TOPIC VALUE  publishes as another task would during the wait of an executor, and prints `wakes COUNT`:
 *                          how often that woke it (with WAITS_HERE: without port_posix_wait.c)
 *   end                    prints `sessions COUNT`: how many others could be opened while this one was closed, and how
 *                          often it was no longer closed
 * The first argument is what port_time_ms starts with. */
#define _POSIX_C_SOURCE 200809L
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw/init.h>
#include <rmw/serialized_message.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"

enum { TOPICS = 2, LINE = 80, BYTES = 1024 };

#ifndef LATE
#define LATE false
#endif

static const char * const out_names[TOPICS] = {"/" OWN "/best", "/" OWN "/sure"};
static const char * const in_names[TOPICS] = {"/" OTHER "/best", "/" OTHER "/sure"};
static rcl_publisher_t publishers[TOPICS];
static uint32_t offset_ms;
static bool closes;
static unsigned sessions;
static unsigned times; /* that the time was read */

/* Counts a session that is no longer closed while it is being closed. */
static void watch_state(void)
{
  static uint8_t last;
  const uint8_t state = rmw_client_instance()->session.state;

  if (closes && last == (uint8_t)XRCE_CLOSED && state != (uint8_t)XRCE_CLOSED) {
    ++sessions;
  }
  last = state;
}

/* Instead of port_posix_time.c. */
uint32_t port_time_ms(void)
{
  struct timespec now = {0, 0};

  ++times;
  watch_state();
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return offset_ms + (uint32_t)((uint64_t)now.tv_sec * 1000u + (uint64_t)now.tv_nsec / 1000000u);
}

int64_t port_time_epoch_ns(void)
{
  return 0;
}

/* As another task while this one waits for the end of its session. */
static void open_another(void)
{
  rmw_init_options_t options = rmw_get_zero_initialized_init_options();
  rmw_context_t context = rmw_get_zero_initialized_context();

  closes = false;
  if (
    rmw_init_options_init(&options, rcutils_get_default_allocator()) != RMW_RET_OK ||
    rmw_init(&options, &context) == RMW_RET_OK) {
    ++sessions;
  }
  closes = true;
}

void port_sleep_ms(uint32_t duration_ms)
{
  struct timespec left = {0, (long)duration_ms * 1000000L};

  if (closes) {
    open_another();
  }
  while (nanosleep(&left, &left) != 0 && errno == EINTR) {
  }
}

static rcl_ret_t publish(unsigned topic, int value)
{
  const std_msgs__msg__Int32 message = {.data = value};

  return rcl_publish(&publishers[topic], &message, NULL);
}

#ifdef WAITS_HERE
static unsigned wakes;
static unsigned meanwhile_topic;
static int meanwhile_value;
static rcl_ret_t meanwhile_result;
static bool meanwhile;

void port_wait(intptr_t handle, uint32_t timeout_ms)
{
  (void)handle;
  (void)timeout_ms;
  if (meanwhile) {
    wakes = 0;
    meanwhile_result = publish(meanwhile_topic, meanwhile_value);
    (void)printf("wakes %u\n", wakes);
    meanwhile = false;
  }
  port_sleep_ms(1);
}

void port_wake(void)
{
  ++wakes;
}

static rcl_ret_t publish_meanwhile(rclc_executor_t * executor, unsigned topic, int value)
{
  meanwhile_topic = topic;
  meanwhile_value = value;
  meanwhile = true;
  while (meanwhile) {
    (void)rclc_executor_spin_some(executor, RCL_MS_TO_NS(5));
  }
  return meanwhile_result;
}
#endif

static void hear(const void * message, void * context)
{
  (void)printf("got %s %d\n", (const char *)context, (int)((const std_msgs__msg__Int32 *)message)->data);
}

static int answer(rcl_ret_t code)
{
  (void)printf("ret %d %s\n", (int)code, code == RCL_RET_OK ? "" : rcl_get_error_string().str);
  rcl_reset_error();
  return fflush(stdout);
}

static void spin(rclc_executor_t * executor, uint32_t duration_ms)
{
  const uint32_t start = port_time_ms();

  do {
    (void)rclc_executor_spin_some(executor, RCL_MS_TO_NS(1));
  } while (port_time_ms() - start < duration_ms);
}

static rcl_ret_t publish_bytes(const rcl_publisher_t * publisher, size_t size)
{
  static uint8_t bytes[BYTES] = {0, 1};
  rcl_serialized_message_t message = rmw_get_zero_initialized_serialized_message();

  message.buffer = bytes;
  message.buffer_length = size;
  message.buffer_capacity = sizeof(bytes);
  return rcl_publish_serialized_message(publisher, &message, NULL);
}

static void continue_with(uint16_t number)
{
  xrce_client_t * client = rmw_client_instance();

  for (unsigned i = 0; i < (unsigned)MICROROS_PEERS; ++i) {
    client->peers[i].number = number;
    client->peers[i].first = number;
    client->peers[i].newest = (uint16_t)(number - 1u);
    client->peers[i].next = number;
  }
}

static rcl_node_t node;
static rclc_executor_t executor;
static rcl_subscription_t subscriptions[TOPICS];

static rcl_ret_t open_subscription(unsigned i)
{
  static char topics[TOPICS][2] = {"0", "1"};
  static std_msgs__msg__Int32 heard[TOPICS];
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rcl_ret_t result = i == 0
                             ? rclc_subscription_init_best_effort(&subscriptions[i], &node, type, in_names[i])
                             : rclc_subscription_init_default(&subscriptions[i], &node, type, in_names[i]);

  return result != RCL_RET_OK ? result
                              : rclc_executor_add_subscription_with_context(
                                  &executor, &subscriptions[i], &heard[i], hear, topics[i], ON_NEW_DATA);
}

static rcl_ret_t close_subscription(unsigned i)
{
  const rcl_ret_t result = rclc_executor_remove_subscription(&executor, &subscriptions[i]);

  return result != RCL_RET_OK ? result : rcl_subscription_fini(&subscriptions[i], &node);
}

int main(int argc, char ** argv)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rclc_support_t support;
  char line[LINE];
  unsigned topic;
  int value;

  node = rcl_get_zero_initialized_node();
  executor = rclc_executor_get_zero_initialized_executor();
  if (argc > 1) {
    offset_ms = (uint32_t)strtoul(argv[1], NULL, 0) - port_time_ms();
  }
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "board", "", &support) != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, TOPICS, &allocator) != RCL_RET_OK) {
    return 2;
  }
  for (size_t i = 0; i < (size_t)TOPICS; ++i) {
    subscriptions[i] = rcl_get_zero_initialized_subscription();
    if (
      (i == 0 ? rclc_publisher_init_best_effort(&publishers[i], &node, type, out_names[i])
              : rclc_publisher_init_default(&publishers[i], &node, type, out_names[i])) != RCL_RET_OK ||
      (!LATE && open_subscription((unsigned)i) != RCL_RET_OK)) {
      (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
      return 3;
    }
  }
  while (fgets(line, sizeof(line), stdin) != NULL) {
    rcl_ret_t code = RCL_RET_OK;

    if (sscanf(line, "publish %u %d", &topic, &value) == 2 && topic < TOPICS) {
      code = publish(topic, value);
#ifdef WAITS_HERE
    } else if (sscanf(line, "meanwhile %u %d", &topic, &value) == 2 && topic < TOPICS) {
      code = publish_meanwhile(&executor, topic, value);
#endif
    } else if (sscanf(line, "spin %d", &value) == 1) {
      spin(&executor, (uint32_t)value);
    } else if (sscanf(line, "rest %d", &value) == 1) {
      times = 0;
      (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(value));
      (void)printf("times %u\n", times);
    } else if (sscanf(line, "serialized %u %d", &topic, &value) == 2 && topic < TOPICS) {
      code = publish_bytes(&publishers[topic], (size_t)value);
    } else if (strcmp(line, "reconnects\n") == 0) {
      rmw_uros_statistics_t statistics;

      code = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics);
      (void)printf("reconnects %u\n", (unsigned)statistics.reconnects);
    } else if (strcmp(line, "dropped\n") == 0) {
      rmw_uros_statistics_t statistics;

      code = rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics);
      (void)printf("dropped %u\n", (unsigned)statistics.dropped);
    } else if (sscanf(line, "pass %d", &value) == 1) {
      offset_ms += (uint32_t)value;
    } else if (sscanf(line, "open %u", &topic) == 1 && topic < TOPICS) {
      code = open_subscription(topic);
    } else if (sscanf(line, "close %u", &topic) == 1 && topic < TOPICS) {
      code = close_subscription(topic);
    } else if (sscanf(line, "numbers %d", &value) == 1) {
      continue_with((uint16_t)value);
    } else if (strcmp(line, "end\n") == 0) {
      break;
    } else {
      return 4;
    }
    if (answer(code) != 0) {
      return 5;
    }
  }
  for (size_t i = 0; i < (size_t)TOPICS; ++i) {
    if (
      rcl_publisher_fini(&publishers[i], &node) != RCL_RET_OK ||
      (rcl_subscription_is_valid(&subscriptions[i]) &&
       rcl_subscription_fini(&subscriptions[i], &node) != RCL_RET_OK)) {
      return 6;
    }
  }
  closes = true;
  if (
    rclc_executor_fini(&executor) != RCL_RET_OK || rcl_node_fini(&node) != RCL_RET_OK ||
    rclc_support_fini(&support) != RCL_RET_OK) {
    return 7;
  }
  closes = false;
  (void)printf("sessions %u\n", sessions);
  return answer(RCL_RET_OK);
}
