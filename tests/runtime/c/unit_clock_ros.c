/* SPDX-License-Identifier: Apache-2.0 */
/* ROS time from /clock: two ROS clocks, two subscriptions of the application besides that of the library. */
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <string.h>

enum { CLOCK_INDEX = 3 }; /* the publishers have the first places */

static const int64_t ms = 1000000;
static const int64_t s = 1000000000;

static rcl_allocator_t allocator;
static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static int calls;
static int64_t called_at;
static int64_t jumped[2]; /* what the clock said before and after the last jump */
static int jumps;

static int64_t now_of(rcl_clock_t * clock)
{
  rcl_time_point_value_t now = -1;

  CHECK(rcl_clock_get_now(clock, &now) == RCL_RET_OK);
  return now;
}

static void on_timer(rcl_timer_t * timer, int64_t last_call_time)
{
  (void)last_call_time;
  CHECK(timer != NULL);
  ++calls;
  called_at = now_of(&support.clock);
}

static void on_jump(const rcl_time_jump_t * jump, bool before_jump, void * user_data)
{
  CHECK(user_data == &jumped && jump->clock_change == RCL_ROS_TIME_NO_CHANGE);
  jumped[before_jump ? 0 : 1] = now_of(&support.clock);
  jumps += before_jump ? 0 : 1;
}

/* A time arrives; nobody has received it yet. */
static void offer(int64_t time)
{
  const int32_t sec = (int32_t)(time / s);
  const uint32_t nanosec = (uint32_t)(time % s);
  uint8_t body[8];

  memcpy(&body[0], &sec, 4);
  memcpy(&body[4], &nanosec, 4);
  agent_offer(CLOCK_INDEX, body, sizeof(body));
}

static void spin(void)
{
  CHECK(rclc_executor_spin_some(&executor, (uint64_t)(10 * ms)) == RCL_RET_OK);
}

/* How often the timer was called when it is `time`. */
static int calls_at(int64_t time)
{
  calls = 0;
  offer(time);
  for (int i = 0; i < 4; ++i) {
    spin();
  }
  CHECK(now_of(&support.clock) == time);
  return calls;
}

static void open_node(void)
{
  CHECK(rclc_node_init_default(&node, "runner", "", &support) == RCL_RET_OK);
  for (int i = 0; i < 4; ++i) {
    (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)); /* until READ_DATA is out */
  }
}

static void test_before_the_first_time(void)
{
  bool is_enabled = false;

  CHECK(support.clock.type == RCL_ROS_TIME && now_of(&support.clock) == 0);
  CHECK(!rcl_clock_time_started(&support.clock));
  CHECK(rcl_is_enabled_ros_time_override(&support.clock, &is_enabled) == RCL_RET_OK && is_enabled);
  calls = 0;
  agent_waits = 0;
  CHECK(rclc_executor_spin_some(&executor, (uint64_t)(5 * s)) == RCL_RET_OK);
  CHECK(calls == 0 && agent_waits < 150u); /* it rests, and asks at times whether the agent is there */
}

/* A timer of 100 ms that was started at 0. */
static void test_time_runs_stops_and_jumps(void)
{
  CHECK(calls_at(50 * s + 10 * ms) == 1 && called_at == 50 * s + 10 * ms); /* what was missed is left out */
  CHECK(calls_at(50 * s + 99 * ms) == 0);
  CHECK(calls_at(50 * s + 100 * ms) == 1);
  agent_now_ns += 3 * s; /* it stands still while time goes by */
  CHECK(calls_at(50 * s + 100 * ms) == 0);
  for (int64_t i = 1; i <= 40; ++i) { /* in steps of 25 ms, however long they take */
    CHECK(calls_at(50 * s + 100 * ms + i * 25 * ms) == (i % 4 == 0 ? 1 : 0));
    agent_now_ns += i % 2 == 0 ? 1 * ms : 400 * ms;
  }
  CHECK(
    calls_at(70 * s + 30 * ms) == 1 && calls_at(70 * s + 99 * ms) == 0); /* forward: once, and on the grid */
  CHECK(calls_at(70 * s + 50 * ms) == 0 && calls_at(70 * s + 100 * ms) == 1); /* back a little: as it was */
  CHECK(calls_at(5 * s + 40 * ms) == 0 && calls_at(5 * s + 139 * ms) == 0); /* back far: the period begins */
  CHECK(calls_at(5 * s + 140 * ms) == 1 && calls_at(5 * s + 240 * ms) == 1);
}

static void test_jump_callbacks(void)
{
  const rcl_jump_threshold_t second = {true, {s}, {-s}};

  CHECK(rcl_clock_add_jump_callback(&support.clock, second, on_jump, &jumped) == RCL_RET_OK);
  (void)calls_at(6 * s);
  CHECK(jumps == 0);
  (void)calls_at(8 * s);
  CHECK(jumps == 1 && jumped[0] == 6 * s && jumped[1] == 8 * s);
  (void)calls_at(7 * s);
  CHECK(jumps == 2 && jumped[0] == 8 * s && jumped[1] == 7 * s);
  CHECK(rcl_clock_remove_jump_callback(&support.clock, on_jump, &jumped) == RCL_RET_OK);
}

/* Whatever receives brings the time, not only the executor; of several samples the newest one counts. */
static void test_without_the_executor(void)
{
  rmw_context_t * context = rcl_context_get_rmw_context(&support.context);

  offer(9 * s);
  offer(10 * s);
  CHECK(now_of(&support.clock) == 7 * s);
  CHECK(rmw_uros_spin_once(context) == RMW_RET_OK && now_of(&support.clock) == 10 * s);
  agent_offer(CLOCK_INDEX, (const uint8_t *)"\1\2\3", 3); /* no time */
  offer(11 * s);
  CHECK(rmw_uros_spin_once(context) == RMW_RET_OK && now_of(&support.clock) == 11 * s);
  agent_offer(CLOCK_INDEX, (const uint8_t *)"\1\2\3", 3);
  CHECK(rmw_uros_spin_once(context) == RMW_RET_OK && now_of(&support.clock) == 11 * s);
}

static void test_other_clocks(void)
{
  rcl_clock_t other;
  rcl_clock_t third;

  CHECK(rcl_clock_init(RCL_ROS_TIME, &other, &allocator) == RCL_RET_OK && now_of(&other) == 11 * s);
  CHECK(rcl_clock_init(RCL_ROS_TIME, &third, &allocator) == RCL_RET_BAD_ALLOC);
  CHECK(strstr(rcl_get_error_string().str, "pools: {ros_clocks: 3}") != NULL);
  agent_epoch_ns = 1000 * s;
  CHECK(rcl_disable_ros_time_override(&other) == RCL_RET_OK && now_of(&other) == 1000 * s);
  CHECK(calls_at(12 * s) >= 0 && now_of(&other) == 1000 * s);
  CHECK(rcl_enable_ros_time_override(&other) == RCL_RET_OK && now_of(&other) == 12 * s);
  CHECK(calls_at(13 * s) >= 0 && now_of(&other) == 13 * s);
  CHECK(rcl_clock_fini(&other) == RCL_RET_OK);
}

/* The place of /clock is none of those that `pools` gives. */
static void test_places(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_subscription_t subscriptions[3];

  CHECK(rclc_subscription_init_best_effort(&subscriptions[0], &node, type, "one") == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[1], &node, type, "two") == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&subscriptions[2], &node, type, "three") == RCL_RET_ERROR);
  CHECK(strstr(rcl_get_error_string().str, "all 2 subscriptions") != NULL);
  CHECK(strstr(rcl_get_error_string().str, "pools: {subscriptions: 3}") != NULL);
  CHECK(calls_at(14 * s) >= 0);
  CHECK(
    rcl_subscription_fini(&subscriptions[0], &node) == RCL_RET_OK &&
    rcl_subscription_fini(&subscriptions[1], &node) == RCL_RET_OK);
}

static void test_a_node_comes_again(void)
{
  rcl_node_t second = rcl_get_zero_initialized_node();

  CHECK(rclc_node_init_default(&second, "second", "", &support) == RCL_RET_OK);
  CHECK(rcl_node_fini(&second) == RCL_RET_OK && calls_at(15 * s) >= 0); /* it had not the subscription */
  CHECK(rcl_node_fini(&node) == RCL_RET_OK);
  spin();
  CHECK(now_of(&support.clock) == 15 * s);
  open_node();
  CHECK(calls_at(16 * s) >= 0);
}

/* A support takes its ROS clock, and releases it. */
static void test_a_support_comes_again(void)
{
  for (int i = 0; i < 5; ++i) {
    CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
    open_node();
    CHECK(now_of(&support.clock) == (16 + i) * s);
    offer((17 + i) * s);
    (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
    CHECK(now_of(&support.clock) == (17 + i) * s);
    CHECK(rcl_node_fini(&node) == RCL_RET_OK && rclc_support_fini(&support) == RCL_RET_OK);
    CHECK(support.clock.type == RCL_CLOCK_UNINITIALIZED);
  }
}

int main(void)
{
  rcl_timer_t timer;

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  open_node();
  CHECK(rclc_timer_init_default2(&timer, &support, (uint64_t)(100 * ms), on_timer, true) == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK);
  test_before_the_first_time();
  test_time_runs_stops_and_jumps();
  test_jump_callbacks();
  test_without_the_executor();
  test_other_clocks();
  test_places();
  test_a_node_comes_again();
  CHECK(rcl_timer_fini(&timer) == RCL_RET_OK && rclc_executor_fini(&executor) == RCL_RET_OK);
  CHECK(rcl_node_fini(&node) == RCL_RET_OK && rclc_support_fini(&support) == RCL_RET_OK);
  test_a_support_comes_again();
  return 0;
}
