/* SPDX-License-Identifier: Apache-2.0 */
/* Stamps from clocks: without a time yet, at the end of 2038's seconds, and of simulated time. */
#include "port_agent.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/stamp.h>

#include <string.h>

static const int64_t second = 1000000000;

static rcl_allocator_t allocator;

static bool is_stamp(rcl_clock_t * clock, int32_t sec, uint32_t nanosec)
{
  int32_t found = -1;
  uint32_t rest = 0;

  return rclc_stamp(clock, &found, &rest) == RCL_RET_OK && found == sec && rest == nanosec;
}

static bool is_refused(rcl_clock_t * clock, rcl_ret_t code, const char * words)
{
  int32_t sec = -7;
  uint32_t nanosec = 7;
  const rcl_ret_t result = rclc_stamp(clock, &sec, &nanosec);
  const bool says = strstr(rcl_get_error_string().str, words) != NULL;

  rcl_reset_error();
  return result == code && says && sec == -7 && nanosec == 7u;
}

static void test_time_of_day(rcl_clock_type_t type)
{
  const int64_t end = ((int64_t)INT32_MAX + 1) * second;
  rcl_clock_t clock;

  CHECK(rcl_clock_init(type, &clock, &allocator) == RCL_RET_OK);
  agent_epoch_ns = 0;
  CHECK(
    is_refused(&clock, RCL_RET_ERROR, "it has no time for a stamp yet")); /* time since the start is none */
  agent_epoch_ns = 1700000000 * second + 123456789;
  CHECK(is_stamp(&clock, 1700000000, 123456789u));
  agent_epoch_ns = end - 1;
  CHECK(is_stamp(&clock, INT32_MAX, 999999999u));
  agent_epoch_ns = end;
  CHECK(is_refused(&clock, RCL_RET_ERROR, "2038"));
  agent_epoch_ns = 0;
  CHECK(rcl_clock_fini(&clock) == RCL_RET_OK);
}

static void test_simulated_time(void)
{
  rcl_clock_t clock;

  CHECK(rcl_clock_init(RCL_ROS_TIME, &clock, &allocator) == RCL_RET_OK);
  CHECK(rcl_enable_ros_time_override(&clock) == RCL_RET_OK);
  CHECK(is_refused(&clock, RCL_RET_ERROR, "it has no time for a stamp yet"));
  CHECK(rcl_set_ros_time_override(&clock, 5 * second + 6) == RCL_RET_OK && is_stamp(&clock, 5, 6u));
  CHECK(rcl_disable_ros_time_override(&clock) == RCL_RET_OK);
  CHECK(is_refused(&clock, RCL_RET_ERROR, "it has no time for a stamp yet"));
  CHECK(rcl_clock_fini(&clock) == RCL_RET_OK);
}

static void test_arguments(void)
{
  rcl_clock_t clock;
  int32_t sec;
  uint32_t nanosec;

  CHECK(rcl_clock_init(RCL_STEADY_TIME, &clock, &allocator) == RCL_RET_OK);
  agent_epoch_ns = second;
  CHECK(is_refused(&clock, RCL_RET_ERROR, "it has no time for a stamp yet")); /* no time of ROS */
  CHECK(rclc_stamp(&clock, NULL, &nanosec) == RCL_RET_INVALID_ARGUMENT);
  CHECK(rclc_stamp(&clock, &sec, NULL) == RCL_RET_INVALID_ARGUMENT);
  CHECK(is_refused(NULL, RCL_RET_INVALID_ARGUMENT, "clock"));
  CHECK(rcl_clock_fini(&clock) == RCL_RET_OK);
  CHECK(rcl_clock_init(RCL_CLOCK_UNINITIALIZED, &clock, &allocator) == RCL_RET_OK);
  CHECK(is_refused(&clock, RCL_RET_ERROR, "not initialized"));
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  test_time_of_day(RCL_SYSTEM_TIME);
  test_time_of_day(RCL_ROS_TIME);
  test_simulated_time();
  test_arguments();
  return 0;
}
