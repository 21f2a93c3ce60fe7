/* SPDX-License-Identifier: Apache-2.0 */
/* rmw_uros_flush waits for what was published before it, while another task publishes all the time. */
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

enum { MS = 1000000, FLUSH_MS = 2000, LOST_MS = 400, NUMBERS = 70000 };

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_publisher_t publisher;
static int32_t published;

static bool publish(void)
{
  const std_msgs__msg__Int32 message = {published + 1};
  const bool is_published = rcl_publish(&publisher, &message, NULL) == RCL_RET_OK;

  if (is_published) {
    ++published;
  } else {
    rcl_reset_error();
  }
  return is_published;
}

static void repeat(void (*event)(void))
{
  agent_event = event;
  agent_event_ns = agent_now_ns + MS;
}

/* The other task: one message each millisecond. The agent acknowledges it just before the next one. */
static void go_on(void)
{
  repeat(go_on);
  if (!agent_silent) {
    agent_acknowledge();
  }
  (void)publish();
}

/* It goes on without the agent for a while. */
static void return_later(void)
{
  static int32_t since;

  repeat(return_later);
  agent_silent = since < LOST_MS;
  since = agent_silent ? since + 1 : 0;
  if (!agent_silent) {
    repeat(go_on);
  }
  (void)publish();
}

static uint32_t reconnects(void)
{
  rmw_uros_statistics_t counted;

  CHECK(rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &counted) == RMW_RET_OK);
  return counted.reconnects;
}

static rmw_ret_t flush(uint32_t timeout_ms)
{
  return rmw_uros_flush(rcl_context_get_rmw_context(&support.context), timeout_ms);
}

static void check_others_do_not_prolong_it(void)
{
  int64_t start;

  CHECK(publish());
  start = agent_now_ns;
  repeat(go_on);
  CHECK(flush(FLUSH_MS) == RMW_RET_OK);
  CHECK(published > 1 && agent_now_ns - start < INT64_C(10) * MS);
}

static void check_wait_for_all_acked(void)
{
  CHECK(publish());
  repeat(go_on);
  CHECK(rcl_publisher_wait_for_all_acked(&publisher, RCL_MS_TO_NS(FLUSH_MS)) == RCL_RET_OK);
}

/* As many as there are numbers, and more. */
static void check_wrap(void)
{
  for (const int32_t end = published + NUMBERS; published < end;) {
    repeat(go_on);
    CHECK(flush(FLUSH_MS) == RMW_RET_OK);
    (void)publish();
  }
}

/* What nobody acknowledges is waited for, to the end. */
static void check_timeout(void)
{
  const int64_t start = agent_now_ns;

  agent_event = NULL;
  CHECK(publish());
  CHECK(flush(50) == RMW_RET_TIMEOUT);
  CHECK(agent_now_ns - start >= INT64_C(50) * MS);
}

static void check_reconnection(void)
{
  const uint32_t before = reconnects();
  int32_t last = 0;

  agent_silent = true;
  (void)publish();
  (void)agent_written(&last);
  repeat(return_later);
  CHECK(flush(100 * FLUSH_MS) == RMW_RET_OK);
  CHECK(reconnects() == before + 1u);
  CHECK(agent_written(&last) != 0u); /* which the lost agent never got */
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "runner", "", &support) == RCL_RET_OK);
  CHECK(
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "out") == RCL_RET_OK);
  agent_keeps_silent = true;
  check_others_do_not_prolong_it();
  check_wait_for_all_acked();
  check_wrap();
  check_timeout();
  check_reconnection();
  CHECK(published > NUMBERS);
  return 0;
}
