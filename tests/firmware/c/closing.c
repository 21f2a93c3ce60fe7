/* SPDX-License-Identifier: Apache-2.0 */
/* Twice: begins a session, publishes while the line takes nothing, and ends the session. closing_report says how far it is. */
#include <microros/port.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

enum { SESSIONS = 2, COUNT = 4000, PAUSE_MS = 2500, STEP_MS = 2 };

typedef struct closing_report_t {
  uint32_t ready; /* sessions that were begun: the line may stop now */
  uint32_t published;
  uint32_t closed;
  uint32_t taken[SESSIONS];    /* messages */
  uint32_t close_ms[SESSIONS]; /* how long the end took */
} closing_report_t;

volatile closing_report_t closing_report;

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;

static bool start(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "closes", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_best_effort(
           &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") == RCL_RET_OK;
}

static void publish(volatile uint32_t * taken)
{
  std_msgs__msg__Int32 message = {0};

  for (uint32_t i = 0; i < COUNT; ++i) {
    message.data = (int32_t)*taken;
    if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
      *taken = *taken + 1u;
    }
  }
}

static bool stop(void)
{
  return rcl_publisher_fini(&publisher, &node) == RCL_RET_OK && rcl_node_fini(&node) == RCL_RET_OK &&
         rclc_support_fini(&support) == RCL_RET_OK;
}

int main(void)
{
  for (uint32_t session = 0; session < SESSIONS; ++session) {
    uint32_t begun_ms;

    if (!start()) {
      return 1;
    }
    closing_report.ready = session + 1u;
    port_sleep_ms(PAUSE_MS);
    publish(&closing_report.taken[session]);
    closing_report.published = session + 1u;
    begun_ms = port_time_ms();
    if (!stop()) {
      return 2;
    }
    closing_report.close_ms[session] = port_time_ms() - begun_ms;
    closing_report.closed = session + 1u;
    port_sleep_ms(PAUSE_MS); /* the line may go on */
  }
  for (;;) {
    port_sleep_ms(STEP_MS);
  }
}
