/* SPDX-License-Identifier: Apache-2.0 */
/* Functions that are called when a subscription is silent: when, how often, over the wrap, without an agent. */
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <string.h>

enum { FIRST_READER = 3 };

static const int64_t ms = 1000000;
static const int64_t day_ms = 86400000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_subscription_t subscriptions[2];
static rclc_executor_t executor;
static std_msgs__msg__Int32 messages[2];
static int64_t stopped_ns;
static uint32_t stops;
static uint32_t offs;
static uint32_t received;

/* What the application file names for the first subscription. */
void stop_motors(void)
{
  ++stops;
  stopped_ns = agent_now_ns;
}

/* For the second one. */
void switch_off(void)
{
  ++offs;
}

static void on_message(const void * message)
{
  (void)message;
  ++received;
}

static void open_all(const rmw_qos_profile_t * qos)
{
  static const char * const topics[2] = {"speed", "light"};

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  node = rcl_get_zero_initialized_node();
  CHECK(rclc_node_init_default(&node, "n", "", &support) == RCL_RET_OK);
  executor = rclc_executor_get_zero_initialized_executor();
  CHECK(rclc_executor_init(&executor, &support.context, 2, &allocator) == RCL_RET_OK);
  for (size_t i = 0; i < 2u; ++i) {
    subscriptions[i] = rcl_get_zero_initialized_subscription();
    CHECK(
      rclc_subscription_init(
        &subscriptions[i], &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), topics[i], qos) ==
      RCL_RET_OK);
    CHECK(
      rclc_executor_add_subscription(&executor, &subscriptions[i], &messages[i], on_message, ON_NEW_DATA) ==
      RCL_RET_OK);
  }
}

static void close_all(void)
{
  CHECK(rclc_executor_fini(&executor) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&subscriptions[0], &node) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&subscriptions[1], &node) == RCL_RET_OK);
  CHECK(rcl_node_fini(&node) == RCL_RET_OK);
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
  rcl_reset_error();
}

/* The executor waits: what is called at the right moment was waited for. */
static void spin(int64_t milliseconds)
{
  const int64_t end = agent_now_ns + milliseconds * ms;

  while (agent_now_ns < end) {
    agent_waits = 0;
    (void)rclc_executor_spin_some(&executor, (uint64_t)(end - agent_now_ns));
    rcl_reset_error();
  }
}

static void forget(void)
{
  stops = 0;
  offs = 0;
}

static void test_once_for_each_silence(void)
{
  int64_t since_ns;

  spin(400);
  CHECK(stops == 0u && rmw_uros_silences() == 0u);
  spin(200);
  CHECK(stops == 1u && rmw_uros_silences() == 1u); /* since it was opened */
  spin(1000);
  CHECK(stops == 1u && offs == 0u);
  spin(1000);
  CHECK(stops == 1u && offs == 1u && rmw_uros_silences() == 2u);
  received = 0;
  for (int i = 0; i < 20; ++i) { /* in time: each 300 ms */
    agent_offer_number(FIRST_READER, i);
    spin(300);
  }
  CHECK(received == 20u && stops == 1u && offs == 1u && rmw_uros_silences() == 1u);
  since_ns = agent_now_ns;
  agent_offer_number(FIRST_READER, 20);
  spin(2000);
  CHECK(received == 21u && stops == 2u && offs == 1u);
  CHECK(stopped_ns - since_ns >= 500 * ms && stopped_ns - since_ns <= 502 * ms);
}

/* Two samples that wait while the program computes for a second are no silence. */
static void test_a_slow_program(void)
{
  agent_offer_number(FIRST_READER, 1);
  spin(10);
  forget();
  agent_now_ns += 1000 * ms;
  agent_offer_number(FIRST_READER, 2);
  spin(400);
  CHECK(stops == 0u);
  spin(200);
  CHECK(stops == 1u);
}

static void test_without_the_agent(void)
{
  agent_offer_number(FIRST_READER, 1);
  spin(10);
  forget();
  agent_silent = true;
  spin(480);
  CHECK(stops == 0u);
  spin(20);
  CHECK(stops == 1u);
  spin(20000); /* the session is lost */
  CHECK(!rmw_uros_is_connected(rcl_context_get_rmw_context(&support.context)));
  CHECK(stops == 1u && rmw_uros_silences() == 2u);
  agent_silent = false;
  spin(9000);
  CHECK(rmw_uros_is_connected(rcl_context_get_rmw_context(&support.context)) && stops == 1u);
  agent_offer_number(FIRST_READER, 1);
  spin(490);
  CHECK(stops == 1u && rmw_uros_silences() == 1u);
  spin(20);
  CHECK(stops == 2u);
}

/* One that is closed is not silent; one that is opened again has its whole time. */
static void test_closed(void)
{
  forget();
  CHECK(rclc_executor_remove_subscription(&executor, &subscriptions[0]) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&subscriptions[0], &node) == RCL_RET_OK);
  rcl_reset_error();
  spin(3000);
  CHECK(stops == 0u && rmw_uros_silences() == 1u);
  CHECK(
    rclc_subscription_init_default(
      &subscriptions[0], &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "speed") == RCL_RET_OK);
  spin(490);
  CHECK(stops == 0u);
  spin(20);
  CHECK(stops == 1u);
}

static void test_days(void)
{
  for (int step = 0; step < 12; ++step) { /* 60 days, over 2^31 and 2^32 ms */
    agent_now_ns += 5 * day_ms * ms;
    spin(3000); /* what is due after so long is over */
    agent_offer_number(FIRST_READER, step);
    spin(10);
    forget();
    spin(485);
    CHECK(stops == 0u);
    spin(30);
    CHECK(stops == 1u);
  }
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  open_all(&rmw_qos_profile_default);
  test_once_for_each_silence();
  test_a_slow_program();
  test_without_the_agent();
  test_days();
  close_all();
  forget();
  CHECK(rmw_uros_silences() == 0u);
  open_all(&rmw_qos_profile_sensor_data); /* a restart, and best effort */
  test_once_for_each_silence();
  test_closed();
  CHECK(rmw_uros_silences() != 0u);
  CHECK(rclc_support_fini(&support) == RCL_RET_OK); /* its subscriptions are still there */
  CHECK(rmw_uros_silences() == 0u);
  return 0;
}
