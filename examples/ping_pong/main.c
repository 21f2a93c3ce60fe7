/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Everybody who runs this pings with a random id, answers the pings of others, and counts the answers to its own.
 * The id of a ping, "<number>_<device>", is the frame_id of a header.
 */
#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/header.h>

#include <inttypes.h>
#include <string.h>

enum { ID_SIZE = 32 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t ping_publisher;
static rcl_publisher_t pong_publisher;
static rcl_subscription_t ping_subscription;
static rcl_subscription_t pong_subscription;
static rcl_timer_t timer;
static rclc_executor_t executor;

static char ids[3][ID_SIZE];
static std_msgs__msg__Header sent_ping = {.frame_id = {ids[0], 0, ID_SIZE}};
static std_msgs__msg__Header heard_ping = {.frame_id = {ids[1], 0, ID_SIZE}};
static std_msgs__msg__Header heard_pong = {.frame_id = {ids[2], 0, ID_SIZE}};
static char device[ID_SIZE];
static uint32_t pings;
static uint32_t pongs;

static void send_ping(rcl_timer_t * due, int64_t last_call_time)
{
  RCLC_UNUSED(due);
  RCLC_UNUSED(last_call_time);
  const int size = snprintf(ids[0], ID_SIZE, "%" PRIu32 "_%s", ++pings, device);

  sent_ping.frame_id.size = (size_t)size;
  (void)example_tell(rcl_publish(&ping_publisher, &sent_ping, NULL), "ping");
}

/* Returns whether it was this device that sent the ping with that id. */
static bool is_own(const std_msgs__msg__Header * header)
{
  const char * from = strchr(header->frame_id.data, '_');

  return from != NULL && strcmp(from + 1, device) == 0;
}

static void answer_ping(const void * message)
{
  if (!is_own(message)) {
    (void)example_tell(rcl_publish(&pong_publisher, message, NULL), "pong");
  }
}

static void count_pong(const void * message)
{
  const std_msgs__msg__Header * pong = message;

  if (is_own(pong)) {
    (void)printf("pong %" PRIu32 " answers %s\n", ++pongs, pong->frame_id.data);
  }
}

static void create_entities(rcl_allocator_t * allocator)
{
  const rosidl_message_type_support_t * header = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Header);
  rcl_time_point_value_t now = 0;

  example_check(rclc_support_init(&support, 0, NULL, allocator), "support");
  example_check(rclc_node_init_default(&node, "ping_pong", "", &support), "node");
  example_check(rclc_publisher_init_default(&ping_publisher, &node, header, "ping"), "ping");
  example_check(rclc_publisher_init_default(&pong_publisher, &node, header, "pong"), "pong");
  example_check(rclc_subscription_init_default(&ping_subscription, &node, header, "ping"), "pings");
  example_check(rclc_subscription_init_default(&pong_subscription, &node, header, "pong"), "pongs");
  example_check(rclc_timer_init_default2(&timer, &support, RCL_MS_TO_NS(200), send_ping, true), "timer");

  /* No two devices start in the same nanosecond; a multiplication spreads what they differ in. */
  example_check(rcl_clock_get_now(&support.clock, &now), "clock");
  (void)snprintf(device, ID_SIZE, "%08" PRIx32, (uint32_t)now * UINT32_C(2654435761));
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  create_entities(&allocator);
  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 3, &allocator), "executor");
  example_check(rclc_executor_add_timer(&executor, &timer), "add timer");
  example_check(
    rclc_executor_add_subscription(&executor, &ping_subscription, &heard_ping, answer_ping, ON_NEW_DATA),
    "add pings");
  example_check(
    rclc_executor_add_subscription(&executor, &pong_subscription, &heard_pong, count_pong, ON_NEW_DATA),
    "add pongs");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_timer_fini(&timer), "end of the timer");
  example_check(rcl_subscription_fini(&pong_subscription, &node), "end of pongs");
  example_check(rcl_subscription_fini(&ping_subscription, &node), "end of pings");
  example_check(rcl_publisher_fini(&pong_publisher, &node), "end of pong");
  example_check(rcl_publisher_fini(&ping_publisher, &node), "end of ping");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
