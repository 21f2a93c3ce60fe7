/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A device that sleeps more often than a subscription may be silent: each child process is the device between two sleeps, and
 * the memory that all share is what it retains. */
#define _DEFAULT_SOURCE
#include "port_agent.h"
#include "types.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <rmw_microros/sleep.h>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

static const int64_t ms = 1000000;
static const int64_t days = 1500000000; /* milliseconds: 17 days, awake */

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_subscription_t subscriptions[2];
static rclc_executor_t executor;
static std_msgs__msg__Int32 messages[2];
static uint32_t stops;

bool port_udp_open_local(port_udp_t * udp, const char * host, uint16_t port, uint16_t local)
{
  (void)local;
  return port_udp_open(udp, host, port);
}

uint16_t port_udp_local(const port_udp_t * udp)
{
  (void)udp;
  return 1;
}

void stop_motors(void)
{
  ++stops;
}

void switch_off(void)
{
}

static void ignore(const void * message)
{
  (void)message;
}

static void open_all(void)
{
  static const char * const topics[2] = {"speed", "light"};

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  node = rcl_get_zero_initialized_node();
  CHECK(rclc_node_init_default(&node, "n", "", &support) == RCL_RET_OK);
  executor = rclc_executor_get_zero_initialized_executor();
  CHECK(rclc_executor_init(&executor, &support.context, 2, &allocator) == RCL_RET_OK);
  for (size_t i = 0; i < 2u; ++i) {
    CHECK(
      rclc_subscription_init_default(
        &subscriptions[i], &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), topics[i]) ==
      RCL_RET_OK);
    CHECK(
      rclc_executor_add_subscription(&executor, &subscriptions[i], &messages[i], ignore, ON_NEW_DATA) ==
      RCL_RET_OK);
  }
}

static void spin(int64_t milliseconds)
{
  const int64_t end = agent_now_ns + milliseconds * ms;

  while (agent_now_ns < end) {
    agent_waits = 0;
    (void)rclc_executor_spin_some(&executor, (uint64_t)(end - agent_now_ns));
    rcl_reset_error();
  }
}

/* Is awake for 200 ms and `longer` milliseconds, and sleeps; its clock begins at 0 each time. Returns how often the function
 * was called. */
static int live(rmw_uros_retained_t * retained, bool wakes, int64_t longer)
{
  const pid_t child = fork();
  int status = 0;

  CHECK(child >= 0);
  if (child == 0) {
    CHECK(rmw_uros_wake(retained) == wakes);
    open_all();
    spin(200);
    agent_now_ns += longer * ms;
    CHECK(rmw_uros_sleep(rcl_context_get_rmw_context(&support.context), retained, 300) == RMW_RET_OK);
    _exit((int)stops);
  }
  CHECK(waitpid(child, &status, 0) == child && WIFEXITED(status));
  return WEXITSTATUS(status);
}

int main(void)
{
  rmw_uros_retained_t * const retained =
    mmap(NULL, sizeof(*retained), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);

  CHECK(retained != MAP_FAILED);
  CHECK(live(retained, false, 0) == 0);
  CHECK(live(retained, true, 0) == 0);
  CHECK(live(retained, true, 0) == 1);    /* 500 ms awake */
  CHECK(live(retained, true, days) == 1); /* still silent: this program has not heard of it */
  CHECK(live(retained, true, days) == 1);
  CHECK(live(retained, true, 0) == 1); /* and when the milliseconds have wrapped since it became silent */
  return 0;
}
