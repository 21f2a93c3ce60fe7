/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A board with two agents. Publishes 0, 1, …, each again while it is refused, and takes numbers. `agents_report` has
 * how many were accepted, the last number that was taken, the place of the agent in the list, how often it was changed, and
 * whether the clock has wrapped.
 */
#include "late_clock.h"
#include "uart_network.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

enum { ACCEPTED, TAKEN, AGENT, CHANGES, WRAPPED, REPORTS };
enum { PERIOD_MS = 20, DEPTH = 100 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_subscription_t subscription;
static rcl_publisher_t publisher;
static rclc_executor_t executor;
static std_msgs__msg__Int32 taken;

volatile uint32_t agents_report[REPORTS];

static void on_number(const void * message)
{
  agents_report[TAKEN] = (uint32_t)((const std_msgs__msg__Int32 *)message)->data;
}

static bool open_all(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  qos.depth = DEPTH;
  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK &&
         rclc_publisher_init(&publisher, &node, type, "agents_up", &qos) == RCL_RET_OK &&
         rclc_subscription_init_default(&subscription, &node, type, "agents_down") == RCL_RET_OK &&
         rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK &&
         rclc_executor_add_subscription(&executor, &subscription, &taken, on_number, ON_NEW_DATA) ==
           RCL_RET_OK;
}

static void report(void)
{
  rmw_uros_agent_t agent;

  if (rmw_uros_get_agent(rcl_context_get_rmw_context(&support.context), &agent) == RMW_RET_OK) {
    agents_report[AGENT] = agent.index;
    agents_report[CHANGES] = agent.changes;
  }
  agents_report[WRAPPED] = late_has_wrapped();
}

int main(void)
{
  std_msgs__msg__Int32 next = {0};

  while (!open_all()) { /* no agent yet */
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(PERIOD_MS));
    if (rcl_publish(&publisher, &next, NULL) == RCL_RET_OK) {
      ++next.data;
      agents_report[ACCEPTED] = (uint32_t)next.data;
    }
    report();
  }
}
