/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A board of test_peer.py. Publishes 1, 2, 3, ... on /OWN/sure, each number until a slot of the link has taken it, up to
 * PEER_LAST in each life, and each of them once on /OWN/best. Hears /OTHER/sure and /OTHER/best. What happened is where
 * the test's monitor finds it: in peer_report. Each life of the other board begins again with 1.
 */
#include <microros/port_bare.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

enum { TOPICS = 2, BEST = 0, SURE = 1 };

typedef struct heard_t {
  uint32_t count;
  uint32_t first;
  uint32_t last;
  uint32_t lives;  /* 1, and one more for each 1 after it */
  uint32_t misses; /* numbers that do not follow the last one: for best effort, that are not larger */
} heard_t;

typedef struct peer_report_t {
  uint32_t ready; /* support_init and everything after it succeeded */
  uint32_t published;
  uint32_t refused; /* calls of rcl_publish that had to be repeated */
  uint32_t malformed;
  uint32_t fault; /* its cause, 0 without one */
  heard_t heard[TOPICS];
} peer_report_t;

volatile peer_report_t peer_report;

static const char * const out_names[TOPICS] = {"/" OWN "/best", "/" OWN "/sure"};
static const char * const in_names[TOPICS] = {"/" OTHER "/best", "/" OTHER "/sure"};
static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publishers[TOPICS];
static rcl_subscription_t subscriptions[TOPICS];
static std_msgs__msg__Int32 messages[TOPICS];
static rclc_executor_t executor;

static void note(int topic, uint32_t value)
{
  volatile heard_t * heard = &peer_report.heard[topic];
  const uint32_t last = heard->last;

  if (heard->count == 0u) {
    heard->first = value;
    heard->lives = 1;
  } else if (topic == SURE && value == 1u) {
    heard->lives = heard->lives + 1u;
  } else if (topic == SURE ? value != last + 1u : value <= last) {
    heard->misses = heard->misses + 1u;
  }
  heard->last = value;
  heard->count = heard->count + 1u;
}

static void hear_best(const void * message)
{
  note(BEST, (uint32_t)((const std_msgs__msg__Int32 *)message)->data);
}

static void hear_sure(const void * message)
{
  note(SURE, (uint32_t)((const std_msgs__msg__Int32 *)message)->data);
}

static bool start(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  executor = rclc_executor_get_zero_initialized_executor();
  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "board", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_best_effort(&publishers[BEST], &node, type, out_names[BEST]) == RCL_RET_OK &&
         rclc_publisher_init_default(&publishers[SURE], &node, type, out_names[SURE]) == RCL_RET_OK &&
         rclc_subscription_init_best_effort(&subscriptions[BEST], &node, type, in_names[BEST]) ==
           RCL_RET_OK &&
         rclc_subscription_init_default(&subscriptions[SURE], &node, type, in_names[SURE]) == RCL_RET_OK &&
         rclc_executor_init(&executor, &support.context, TOPICS, &allocator) == RCL_RET_OK &&
         rclc_executor_add_subscription(
           &executor, &subscriptions[BEST], &messages[BEST], hear_best, ON_NEW_DATA) == RCL_RET_OK &&
         rclc_executor_add_subscription(
           &executor, &subscriptions[SURE], &messages[SURE], hear_sure, ON_NEW_DATA) == RCL_RET_OK;
}

static void publish_next(void)
{
  const std_msgs__msg__Int32 message = {(int32_t)peer_report.published + 1};

  if (rcl_publish(&publishers[SURE], &message, NULL) != RCL_RET_OK) {
    rcl_reset_error();
    peer_report.refused = peer_report.refused + 1u;
    return;
  }
  peer_report.published = peer_report.published + 1u;
  if (rcl_publish(&publishers[BEST], &message, NULL) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

int main(void)
{
  port_bare_fault_t fault;
  rmw_uros_statistics_t statistics;

  if (port_bare_fault_take(&fault)) {
    peer_report.fault = fault.cause;
  }
  if (!start()) {
    return 1;
  }
  peer_report.ready = 1;
  for (;;) {
    if (peer_report.published < PEER_LAST) {
      publish_next();
    }
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(5));
    if (rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics) == RMW_RET_OK) {
      peer_report.malformed = statistics.malformed;
    }
  }
}
