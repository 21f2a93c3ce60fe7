/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The loops of micro-ROS applications over the one line of a board. LOOP_KEEPS: the session is kept, and pinged while it is
 * looked for; else ping, create, publish, destroy, as every reconnection example has it.
 */
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

typedef struct loop_report_t {
  uint32_t published;
  uint32_t pings;
  uint32_t silent; /* pings without an answer */
  uint32_t begun;  /* sessions */
} loop_report_t;

volatile loop_report_t loop_report;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_publisher_t publisher;

static bool ping(void)
{
  const bool answered = rmw_uros_ping_agent(50, 1) == RMW_RET_OK;

  loop_report.pings = loop_report.pings + 1u;
  loop_report.silent = loop_report.silent + (answered ? 0u : 1u);
  return answered;
}

static bool create(void)
{
  allocator = rcl_get_default_allocator();
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "loop", "", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") != RCL_RET_OK) {
    return false;
  }
  loop_report.begun = loop_report.begun + 1u;
  return true;
}

static void publish(void)
{
  std_msgs__msg__Int32 message = {(int32_t)loop_report.published + 1};

  (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
  if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
    loop_report.published = loop_report.published + 1u;
  }
  rcl_reset_error();
  rclc_sleep_ms(20);
}

#ifdef LOOP_KEEPS
int main(void)
{
  while (!create()) {
    rcl_reset_error();
  }
  for (;;) {
    publish();
    if (!rmw_uros_is_connected(rcl_context_get_rmw_context(&support.context))) {
      (void)ping();
    }
  }
}
#else
static void destroy(void)
{
  (void)rmw_uros_set_context_entity_destroy_session_timeout(rcl_context_get_rmw_context(&support.context), 0);
  (void)rcl_publisher_fini(&publisher, &node);
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

int main(void)
{
  for (;;) {
    if (ping() && create()) {
      for (uint32_t i = 1; i % 10u != 0u || ping(); ++i) {
        publish();
      }
      destroy();
    }
    rcl_reset_error();
    rclc_sleep_ms(50);
  }
}
#endif
