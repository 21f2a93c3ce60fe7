/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with a subscription and a publisher in rclc_executor_spin, an hour of which nothing comes. Prints how often it woke up;
 * then, with the agent gone and with `liveliness: ping` or `acknack`, when it looked for the agent. With an argument the program
 * sleeps itself, as long as the library says.
 */
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <inttypes.h>
#include <stdlib.h>

enum { CREATE_CLIENT = 0 };

static const int64_t second_ns = 1000000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rclc_executor_t executor;
static std_msgs__msg__Int32 number;
static int64_t gone_ns;

static void on_number(const void * message)
{
  (void)message;
}

static void end(void)
{
  printf("woke %" PRIu32 "\n", agent_waits);
  exit(0);
}

static void on_asked(uint8_t id)
{
  if (id == CREATE_CLIENT) {
    printf("asked %" PRId64 "\n", (agent_now_ns - gone_ns) / 1000000);
  }
}

static void go(void)
{
  printf("woke %" PRIu32 "\n", agent_waits);
  agent_waits = 0;
  agent_silent = true;
  agent_asked = on_asked;
  gone_ns = agent_now_ns;
  (void)rcl_publish(&publisher, &number, NULL); /* acknack notices by what is not acknowledged */
  port_wake();
  agent_event = end;
  agent_event_ns = agent_now_ns + 3600 * second_ns;
}

/* As an application that sleeps itself, until an interrupt of the line. */
static int sleep_itself(void)
{
  for (;;) {
    int64_t due_ns = -1;

    (void)rclc_executor_spin_some(&executor, 0);
    CHECK(rclc_executor_time_until_due(&executor, &due_ns) == RCL_RET_OK);
    CHECK(due_ns > 0); /* otherwise it would not sleep */
    port_wait(1, due_ns == INT64_MAX ? UINT32_MAX : (uint32_t)(due_ns / 1000000));
  }
}

int main(int count, char ** arguments)
{
  (void)arguments;
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "n", "", &support) == RCL_RET_OK);
  CHECK(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "out") == RCL_RET_OK);
  CHECK(
    rclc_subscription_init_default(
      &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "in") == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &number, on_number, ON_NEW_DATA) == RCL_RET_OK);
  CHECK(rclc_executor_spin_some(&executor, (uint64_t)(10 * second_ns)) == RCL_RET_OK);
  agent_waits = 0;
  agent_event = go;
  agent_event_ns = agent_now_ns + 3600 * second_ns;
  return count > 1 ? sleep_itself() : (int)rclc_executor_spin(&executor);
}
