/* SPDX-License-Identifier: Apache-2.0 */
/* Clocks alone: two ROS clocks, two jump callbacks. */
#include "port_agent.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <uxr/client/util/time.h>

#include <string.h>

typedef struct jumps_t {
  int before;
  int after;
  rcl_clock_change_t change;
  int64_t delta;
} jumps_t;

static rcl_allocator_t allocator;

static void on_jump(const rcl_time_jump_t * jump, bool before_jump, void * user_data)
{
  jumps_t * jumps = user_data;

  jumps->before += before_jump ? 1 : 0;
  jumps->after += before_jump ? 0 : 1;
  jumps->change = jump->clock_change;
  jumps->delta = jump->delta.nanoseconds;
}

static int64_t now_of(rcl_clock_t * clock)
{
  rcl_time_point_value_t now = -1;

  CHECK(rcl_clock_get_now(clock, &now) == RCL_RET_OK);
  return now;
}

static void test_kinds(void)
{
  rcl_clock_t clock;
  rcl_time_point_value_t now;

  CHECK(rcl_clock_init(RCL_STEADY_TIME, &clock, &allocator) == RCL_RET_OK);
  CHECK(rcl_clock_valid(&clock) && clock.type == RCL_STEADY_TIME && now_of(&clock) == agent_now_ns);
  CHECK(rcl_ros_clock_fini(&clock) == RCL_RET_ERROR && rcl_system_clock_fini(&clock) == RCL_RET_ERROR);
  CHECK(rcl_enable_ros_time_override(&clock) == RCL_RET_ERROR);
  CHECK(strstr(rcl_get_error_string().str, "RCL_ROS_TIME") != NULL);
  CHECK(rcl_clock_fini(&clock) == RCL_RET_OK);

  CHECK(rcl_clock_init(RCL_SYSTEM_TIME, &clock, &allocator) == RCL_RET_OK);
  CHECK(now_of(&clock) == agent_now_ns); /* nobody knows the time of the day */
  agent_epoch_ns = 77;
  CHECK(now_of(&clock) == 77 && rcl_clock_time_started(&clock));
  agent_epoch_ns = 0;
  CHECK(rcl_clock_fini(&clock) == RCL_RET_OK);

  CHECK(rcl_clock_init(RCL_CLOCK_UNINITIALIZED, &clock, &allocator) == RCL_RET_OK);
  CHECK(!rcl_clock_valid(&clock) && rcl_clock_get_now(&clock, &now) == RCL_RET_ERROR);
  CHECK(rcl_clock_fini(&clock) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_clock_init((rcl_clock_type_t)9, &clock, &allocator) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_clock_init(RCL_STEADY_TIME, NULL, &allocator) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_clock_init(RCL_STEADY_TIME, &clock, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_clock_get_now(NULL, &now) == RCL_RET_INVALID_ARGUMENT && !rcl_clock_valid(NULL));
}

static void test_pool_of_ros_clocks(void)
{
  rcl_clock_t clocks[3];

  CHECK(rcl_ros_clock_init(&clocks[0], &allocator) == RCL_RET_OK);
  CHECK(rcl_ros_clock_init(&clocks[1], &allocator) == RCL_RET_OK);
  CHECK(rcl_ros_clock_init(&clocks[2], &allocator) == RCL_RET_BAD_ALLOC);
  CHECK(strstr(rcl_get_error_string().str, "pools: {ros_clocks: 3}") != NULL);
  CHECK(rcl_ros_clock_fini(&clocks[0]) == RCL_RET_OK);
  CHECK(rcl_ros_clock_init(&clocks[2], &allocator) == RCL_RET_OK);
  CHECK(rcl_clock_fini(&clocks[1]) == RCL_RET_OK && rcl_clock_fini(&clocks[2]) == RCL_RET_OK);
}

static void test_override(rcl_clock_t * clock)
{
  bool is_enabled = true;

  agent_epoch_ns = 5000;
  CHECK(rcl_is_enabled_ros_time_override(clock, &is_enabled) == RCL_RET_OK && !is_enabled);
  CHECK(rcl_set_ros_time_override(clock, 100) == RCL_RET_OK && now_of(clock) == 5000);
  CHECK(rcl_enable_ros_time_override(clock) == RCL_RET_OK && now_of(clock) == 100);
  CHECK(rcl_is_enabled_ros_time_override(clock, &is_enabled) == RCL_RET_OK && is_enabled);
  CHECK(rcl_is_enabled_ros_time_override(clock, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_set_ros_time_override(clock, 0) == RCL_RET_OK && !rcl_clock_time_started(clock));
  CHECK(rcl_disable_ros_time_override(clock) == RCL_RET_OK && now_of(clock) == 5000);
}

static void test_jumps(rcl_clock_t * clock)
{
  jumps_t all = {0, 0, 0, 0};
  jumps_t large = {0, 0, 0, 0};
  const rcl_jump_threshold_t any = {true, {1}, {-1}};
  const rcl_jump_threshold_t far_forward = {false, {1000}, {0}};
  const rcl_jump_threshold_t wrong = {true, {-1}, {0}};

  CHECK(rcl_clock_add_jump_callback(clock, wrong, on_jump, &all) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_clock_add_jump_callback(clock, any, NULL, &all) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rcl_clock_add_jump_callback(clock, any, on_jump, &all) == RCL_RET_OK);
  CHECK(rcl_clock_add_jump_callback(clock, any, on_jump, &all) == RCL_RET_ERROR);
  CHECK(rcl_clock_add_jump_callback(clock, far_forward, on_jump, &large) == RCL_RET_OK);
  CHECK(clock->num_jump_callbacks == 2u);
  CHECK(rcl_clock_add_jump_callback(clock, any, on_jump, NULL) == RCL_RET_BAD_ALLOC);
  CHECK(strstr(rcl_get_error_string().str, "pools: {jump_callbacks: 3}") != NULL);

  CHECK(rcl_set_ros_time_override(clock, 10) == RCL_RET_OK && all.before == 0); /* not active */
  CHECK(rcl_enable_ros_time_override(clock) == RCL_RET_OK);
  CHECK(all.before == 1 && all.after == 1 && all.change == RCL_ROS_TIME_ACTIVATED && large.after == 0);
  CHECK(rcl_enable_ros_time_override(clock) == RCL_RET_OK && all.after == 1); /* it was */
  CHECK(rcl_set_ros_time_override(clock, 1009) == RCL_RET_OK);
  CHECK(all.after == 2 && all.change == RCL_ROS_TIME_NO_CHANGE && all.delta == 999 && large.after == 0);
  CHECK(rcl_set_ros_time_override(clock, 2009) == RCL_RET_OK && large.before == 1 && large.delta == 1000);
  CHECK(rcl_set_ros_time_override(clock, 9) == RCL_RET_OK && all.delta == -2000 && large.after == 1);
  CHECK(rcl_clock_remove_jump_callback(clock, on_jump, &all) == RCL_RET_OK);
  CHECK(rcl_clock_remove_jump_callback(clock, on_jump, &all) == RCL_RET_ERROR);
  CHECK(
    rcl_disable_ros_time_override(clock) == RCL_RET_OK && all.after == 4 && clock->num_jump_callbacks == 1u);
}

static void test_difference(void)
{
  const rcl_time_point_t early = {10, RCL_ROS_TIME};
  const rcl_time_point_t late = {25, RCL_ROS_TIME};
  const rcl_time_point_t other = {25, RCL_STEADY_TIME};
  rcl_duration_t delta = {0};

  CHECK(rcl_difference_times(&early, &late, &delta) == RCL_RET_OK && delta.nanoseconds == 15);
  CHECK(rcl_difference_times(&late, &early, &delta) == RCL_RET_OK && delta.nanoseconds == -15);
  CHECK(rcl_difference_times(&early, &other, &delta) == RCL_RET_ERROR);
  CHECK(rcl_difference_times(&early, NULL, &delta) == RCL_RET_INVALID_ARGUMENT);
}

/* The loop of every micro-ROS example: what is to be done every 10 ms is done, whether the time of day is known or not. */
static void test_the_time_of_the_xrce_client(void)
{
  int64_t last = uxr_millis();
  int fired = 0;

  CHECK(agent_epoch_ns == 0 && uxr_nanos() == agent_now_ns && last == agent_now_ns / 1000000);
  for (int i = 0; i < 100; ++i) {
    agent_now_ns += 1000000;
    if (uxr_millis() - last >= 10) {
      last = uxr_millis();
      ++fired;
    }
  }
  CHECK(fired == 10);
  agent_epoch_ns = INT64_C(1790000000123456789);
  CHECK(uxr_nanos() == agent_epoch_ns && uxr_millis() == 1790000000123);
  agent_epoch_ns = 0;
}

int main(void)
{
  rcl_clock_t clock;

  allocator = rcl_get_default_allocator();
  test_kinds();
  test_the_time_of_the_xrce_client();
  test_pool_of_ros_clocks();
  CHECK(rcl_ros_clock_init(&clock, &allocator) == RCL_RET_OK);
  test_override(&clock);
  test_jumps(&clock);
  CHECK(rcl_clock_fini(&clock) == RCL_RET_OK); /* frees the callback that is left */
  CHECK(rcl_ros_clock_init(&clock, &allocator) == RCL_RET_OK);
  test_jumps(&clock);
  test_difference();
  return 0;
}
