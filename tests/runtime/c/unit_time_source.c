/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A client that follows its agent for an hour, whose messages take 0 to 20 ms each way and whose clock is 50 ppm faster; the
 * milliseconds wrap. Then the agent is away for an hour, and comes back with another time. */
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rcutils/time.h>
#include <rmw_microros/rmw_microros.h>
#include <uxr/client/util/time.h>

#include <string.h>

enum { TIMESTAMP = 0x0E, REPLY_SIZE = 32, FIRST_READER = 3 };

static const int64_t ms = 1000000;
static const int64_t second = 1000000000;
static const int64_t faster_ppm = 50;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_guard_condition_t guard;
static rcl_subscription_t subscription;
static int64_t start_ns;
static int64_t epoch_ns = INT64_C(1790000000000000000);
static int64_t originated_ns;
static int64_t received_ns;
static uint32_t questions;
static uint32_t seed = 12345;

/* The agent's clock. */
static int64_t reference(int64_t local_ns)
{
  const int64_t passed = local_ns - start_ns;

  return epoch_ns + passed + passed / 1000000 * faster_ppm;
}

/* 0 to 20 ms, in steps of 256 us. */
static int64_t delay(void)
{
  seed = seed * 1664525u + 1013904223u;
  return (int64_t)((seed >> 16) % 20000u) * 1000;
}

static void put(uint8_t * at, int64_t time_ns)
{
  const uint32_t parts[2] = {(uint32_t)(time_ns / second), (uint32_t)(time_ns % second)};

  for (unsigned i = 0; i < 8u; ++i) {
    at[i] = (uint8_t)(parts[i / 4u] >> (8u * (i % 4u)));
  }
}

static void answer(void)
{
  uint8_t reply[REPLY_SIZE] = {0x81, 0, 0, 0, 0x0F, 1, 24, 0};

  put(&reply[8], received_ns);
  put(&reply[16], received_ns);
  put(&reply[24], originated_ns);
  agent_inject(reply, sizeof(reply));
}

static void asked(uint8_t id)
{
  if (id != (uint8_t)TIMESTAMP) {
    return;
  }
  ++questions;
  if (!agent_silent) {
    const int64_t there = delay();

    originated_ns = agent_now_ns;
    received_ns = reference(agent_now_ns + there);
    agent_event_ns = agent_now_ns + there + delay();
    agent_event = answer;
  }
}

static void ignore(void)
{
}

static void open_session(void)
{
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  node = rcl_get_zero_initialized_node();
  CHECK(rclc_node_init_default(&node, "n", "", &support) == RCL_RET_OK);
  CHECK(
    rclc_subscription_init_best_effort(
      &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "number") == RCL_RET_OK);
  executor = rclc_executor_get_zero_initialized_executor();
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  guard = rcl_get_zero_initialized_guard_condition();
  CHECK(
    rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, ignore) == RCL_RET_OK);
}

static void close_session(void)
{
  CHECK(rclc_executor_fini(&executor) == RCL_RET_OK);
  CHECK(rcl_guard_condition_fini(&guard) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&subscription, &node) == RCL_RET_OK);
  CHECK(rcl_node_fini(&node) == RCL_RET_OK);
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
}

/* Time goes on for so long. The time that is served never goes back and stays within `error_ns` of the agent's. */
static void spin(int64_t duration_ns, int64_t error_ns)
{
  const int64_t end = agent_now_ns + duration_ns;
  int64_t before = rmw_uros_epoch_nanos();

  while (agent_now_ns < end) {
    int64_t now;

    agent_waits = 0;
    (void)rclc_executor_spin_some(&executor, (uint64_t)(end - agent_now_ns));
    rcl_reset_error();
    now = rmw_uros_epoch_nanos();
    CHECK(now >= before);
    before = now;
    CHECK(now - reference(agent_now_ns) <= error_ns && reference(agent_now_ns) - now <= error_ns);
  }
}

static rmw_uros_time_status_t status(void)
{
  rmw_uros_time_status_t found;

  CHECK(rmw_uros_time_source_status(&found) == RMW_RET_OK);
  return found;
}

static void test_before_it(void)
{
  const rmw_uros_time_status_t found = status();

  CHECK(found.state == RMW_UROS_TIME_UNSET && found.accepted == 0u && found.age_ns == 0);
  CHECK(rmw_uros_time_source_status(NULL) == RMW_RET_INVALID_ARGUMENT);
  CHECK(rmw_uros_time_source_sample(0, 0, 0) == RMW_RET_ERROR);
  rcl_reset_error();
  CHECK(!rmw_uros_epoch_synchronized());
}

static void test_hour(void)
{
  rmw_uros_time_status_t found;
  rcl_clock_t clock;
  rcl_time_point_value_t time = 0;

  while (status().state == RMW_UROS_TIME_UNSET) {
    (void)rclc_executor_spin_some(&executor, 1u);
    rcl_reset_error();
  }
  CHECK(rmw_uros_epoch_synchronized());
  spin(600 * second, 10 * ms);
  questions = 0;
  spin(3000 * second, 5 * ms / 2);
  CHECK(questions >= 299u && questions <= 301u); /* one in 10 s */
  found = status();
  CHECK(found.state == RMW_UROS_TIME_FOLLOWING && found.age_ns <= 11 * second && found.rejected == 0u);
  CHECK(found.drift_ppb > 49000 && found.drift_ppb < 51000);
  CHECK(found.uncertainty_ns > 0 && found.uncertainty_ns < 3 * ms);
  CHECK(rmw_uros_sync_session(1000) == RMW_RET_OK); /* a sample as others */
  spin(second, 5 * ms / 2);
  CHECK(status().accepted > found.accepted && status().rejected == 0u);
  CHECK(rcl_clock_init(RCL_SYSTEM_TIME, &clock, &allocator) == RCL_RET_OK);
  CHECK(rcl_clock_get_now(&clock, &time) == RCL_RET_OK && time == rmw_uros_epoch_nanos());
  CHECK(rcutils_system_time_now(&time) == RCUTILS_RET_OK && time == rmw_uros_epoch_nanos());
  CHECK(uxr_nanos() == time && uxr_millis() == time / ms);
  CHECK(rcl_clock_fini(&clock) == RCL_RET_OK);
}

/* A sample has the time of its arrival by the source: the port does not know the time of day. */
static void test_stamp(void)
{
  std_msgs__msg__Int32 number;
  rmw_message_info_t info;
  int64_t late;

  agent_offer_number(FIRST_READER, 7);
  spin(second, 5 * ms / 2);
  CHECK(rcl_take(&subscription, &number, &info, NULL) == RCL_RET_OK && number.data == 7);
  late = rmw_uros_epoch_nanos() - info.received_timestamp;
  CHECK(late >= 0 && late <= second + 10 * ms);
}

/* The session is lost, the drift is not. */
static void test_holdover(void)
{
  const int64_t before_ns = status().uncertainty_ns;

  agent_silent = true;
  spin(3600 * second, 10 * ms);
  CHECK(status().state == RMW_UROS_TIME_HOLDOVER && status().age_ns >= 3595 * second);
  CHECK(status().uncertainty_ns > 2 * before_ns);
  agent_silent = false;
  spin(60 * second, 10 * ms);
  CHECK(status().state == RMW_UROS_TIME_FOLLOWING && status().rejected == 0u);
}

/* The agent's clock is set back by a second: those are outliers first, and then it is slewed. */
static void test_another_time(void)
{
  const rmw_uros_time_status_t before = status();

  epoch_ns -= second;
  spin(60 * second, 2 * second);
  CHECK(status().accepted == before.accepted && status().rejected > before.rejected);
  spin(60 * second, 2 * second);
  CHECK(status().rejected == before.rejected + 7u && status().accepted > before.accepted);
  CHECK(status().offset_ns < -900 * ms);
  spin(2100 * second, 2 * second);
  spin(60 * second, 10 * ms);
  CHECK(status().steps == 0u);
}

int main(void)
{
  agent_asked = asked;
  allocator = rcl_get_default_allocator();
  start_ns = agent_now_ns;
  test_before_it();
  open_session();
  test_hour();
  test_stamp();
  test_holdover();
  test_another_time();
  close_session();
  CHECK(status().state == RMW_UROS_TIME_UNSET && rmw_uros_epoch_nanos() == 0);
  return 0;
}
