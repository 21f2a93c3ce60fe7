/* SPDX-License-Identifier: Apache-2.0 */
/*
 * QoS events of two publishers and a subscription under an executor, until its standard input ends. Each other line takes
 * all events, and is answered with a line each: name, total, change, current and change of it, or the last policy; and
 * with how often callbacks were called since the line before.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rcl/event.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

#include "commanded.h"

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t count;
static rcl_publisher_t fast;
static rcl_subscription_t order;
static rclc_executor_t executor;
static rcl_event_t events[5];
static std_msgs__msg__Int32 message;
static size_t told;

static const char * const names[] = {"count", "order", "count", "fast", "order"};

enum { MATCHED = 2 };

static void on_message(const void * received)
{
  (void)received;
}

static void on_event(const void * user_data, size_t number_of_events)
{
  (void)user_data;
  told += number_of_events;
}

static void open_events(void)
{
  rcl_event_t second = rcl_get_zero_initialized_event();

  for (size_t i = 0; i < sizeof(events) / sizeof(events[0]); ++i) {
    events[i] = rcl_get_zero_initialized_event();
  }
  check(rcl_publisher_event_init(&events[0], &count, RCL_PUBLISHER_MATCHED), "matched");
  check(rcl_subscription_event_init(&events[1], &order, RCL_SUBSCRIPTION_MATCHED), "matched");
  check(rcl_publisher_event_init(&events[2], &count, RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS), "offered");
  check(rcl_publisher_event_init(&events[3], &fast, RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS), "offered");
  check(
    rcl_subscription_event_init(&events[4], &order, RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS),
    "requested");
  if (
    rcl_publisher_event_init(&second, &count, RCL_PUBLISHER_MATCHED) != RCL_RET_ALREADY_INIT ||
    rcl_publisher_event_init(&second, &count, RCL_PUBLISHER_LIVELINESS_LOST) != RCL_RET_UNSUPPORTED) {
    exit(2);
  }
  rcl_reset_error();
  for (size_t i = 0; i < sizeof(events) / sizeof(events[0]); ++i) {
    check(rcl_event_set_callback(&events[i], on_event, NULL), "callback");
  }
}

static void take(size_t index)
{
  if (index < (size_t)MATCHED) {
    rmw_matched_status_t status;

    check(rcl_take_event(&events[index], &status), "take");
    (void)printf(
      "%s matched %zu %zu %zu %d\n", names[index], status.total_count, status.total_count_change,
      status.current_count, (int)status.current_count_change);
  } else {
    rmw_offered_qos_incompatible_event_status_t status;

    check(rcl_take_event(&events[index], &status), "take");
    (void)printf(
      "%s incompatible %d %d %d\n", names[index], (int)status.total_count, (int)status.total_count_change,
      (int)status.last_policy_kind);
  }
}

/* take */
static rcl_ret_t run(char ** words)
{
  (void)words;
  for (size_t i = 0; i < sizeof(events) / sizeof(events[0]); ++i) {
    take(i);
  }
  (void)printf("told %zu\n", told);
  told = 0;
  return rcl_error_is_set() ? RCL_RET_ERROR : RCL_RET_OK;
}

int main(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "device", "arm", &support), "node");
  check(rclc_publisher_init_default(&count, &node, type, "count"), "count");
  check(rclc_publisher_init_best_effort(&fast, &node, type, "fast"), "fast");
  check(rclc_subscription_init_default(&order, &node, type, "order"), "order");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  check(rclc_executor_add_subscription(&executor, &order, &message, on_message, ON_NEW_DATA), "subscription");
  open_events();
  obey(&executor, 5, run);
  check(faults == 0u ? RCL_RET_OK : RCL_RET_ERROR, last_error);
  for (size_t i = 0; i < sizeof(events) / sizeof(events[0]); ++i) {
    check(rcl_event_fini(&events[i]), "event fini");
  }
  check(rclc_executor_fini(&executor), "executor fini");
  check(rcl_subscription_fini(&order, &node), "order fini");
  check(rcl_publisher_fini(&fast, &node), "fast fini");
  check(rcl_publisher_fini(&count, &node), "count fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
