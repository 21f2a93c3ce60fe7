/* SPDX-License-Identifier: Apache-2.0 */
/* Executor, timers and clocks while the milliseconds run through 2^31 and 2^32 in steps of five days. */
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <uxr/client/util/time.h>

enum { STEPS = 12, FIRST_READER = 3 };

static const int64_t ms = 1000000;
static const int64_t step = INT64_C(5) * 86400 * 1000 * 1000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rcl_timer_t timer;
static rcl_guard_condition_t guard;
static rclc_executor_t executor;
static std_msgs__msg__Int32 number;
static int timed;
static int heard;
static int guarded;
static int64_t since;

static void on_timer(rcl_timer_t * called, int64_t last_call_time)
{
  CHECK(called == &timer);
  since = last_call_time;
  ++timed;
}

static void on_number(const void * message)
{
  CHECK(message == &number);
  ++heard;
}

static void on_guard(void)
{
  ++guarded;
}

static void trigger(void)
{
  CHECK(rcl_trigger_guard_condition(&guard) == RCL_RET_OK);
}

static void spin(int64_t timeout_ns)
{
  CHECK(rclc_executor_spin_some(&executor, (uint64_t)timeout_ns) == RCL_RET_OK);
}

/* The session is looked after: what was due while nobody called is done now, and nothing else keeps it busy. */
static void settle(void)
{
  for (int i = 0; i < 5; ++i) {
    spin(10 * ms);
  }
}

static void check_step(int32_t i)
{
  const std_msgs__msg__Int32 message = {i};
  int64_t start;
  int32_t last = -1;

  timed = 0;
  settle();
  CHECK(timed == 1 && since >= step); /* the calls that were missed are one */
  heard = 0;
  agent_offer_number(FIRST_READER, i);
  spin(100 * ms);
  CHECK(heard == 1 && number.data == i);
  CHECK(rcl_publish(&publisher, &message, NULL) == RCL_RET_OK);
  CHECK(agent_written(&last) == 1u && last == i);
  start = agent_now_ns;
  agent_waits = 0;
  spin(100 * ms);
  CHECK(agent_now_ns == start + 100 * ms && agent_waits < 20u);
  guarded = 0;
  agent_event_ns = agent_now_ns + 7 * ms;
  agent_event = trigger;
  start = agent_now_ns;
  spin(100 * ms);
  CHECK(guarded == 1 && agent_now_ns == start + 7 * ms);
  timed = 0;
  spin(2000 * ms);
  CHECK(timed == 1 && since > 0 && since <= 1000 * ms);
  start = agent_now_ns;
  CHECK(rclc_executor_spin_one_period(&executor, (uint64_t)(50 * ms)) == RCL_RET_OK);
  CHECK(agent_now_ns == start + 50 * ms);
  executor.invocation_time = 0;
  CHECK(rmw_uros_flush(rcl_context_get_rmw_context(&support.context), 100) == RMW_RET_OK);
  CHECK(rmw_uros_is_connected(rcl_context_get_rmw_context(&support.context)));
}

static void check_clocks(rcl_clock_t * steady, int64_t begin)
{
  rcl_time_point_value_t now = 0;

  CHECK(rcl_clock_get_now(steady, &now) == RCL_RET_OK && now == agent_now_ns && now > begin);
  CHECK(uxr_nanos() == agent_now_ns);
}

int main(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const int64_t begin = agent_now_ns;

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "runner", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "out") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&subscription, &node, type, "in") == RCL_RET_OK);
  CHECK(rclc_timer_init_default2(&timer, &support, (uint64_t)(1000 * ms), on_timer, true) == RCL_RET_OK);
  guard = rcl_get_zero_initialized_guard_condition();
  CHECK(
    rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 3, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &subscription, &number, on_number, ON_NEW_DATA) == RCL_RET_OK);
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  CHECK(rclc_executor_set_timeout(&executor, (uint64_t)(10 * ms)) == RCL_RET_OK);
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, on_guard) == RCL_RET_OK);
  settle();
  for (int32_t i = 0; i < STEPS; ++i) {
    agent_now_ns += step;
    check_step(i);
    check_clocks(&support.clock, begin);
  }
  CHECK(agent_now_ns - begin > (INT64_C(1) << 32) * ms);
  return 0;
}
