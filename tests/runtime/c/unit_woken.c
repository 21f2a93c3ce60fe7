/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A device of several tasks that sleeps, with a time source: a child process is the device before its sleep, and the memory that
 * both share is what it retains. */
#define _DEFAULT_SOURCE
#include "port_agent.h"
#include "unit.h"

#include "microros/rmw_client.h"
#include "microros/xrce_client.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <rmw_microros/sleep.h>

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { TIMESTAMP = 0x0E, REPLY_SIZE = 32, AWAKE_MS = 500 };

static const int64_t ms = 1000000;
static const int64_t second = 1000000000;
static const int64_t epoch_ns = INT64_C(1790000000000000000);

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_guard_condition_t guard;
static int64_t asked_ns;
static bool has_time = true; /* the agent */

static uint32_t locked;

void port_lock(void)
{
  ++locked;
}

void port_unlock(void)
{
}

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

  put(&reply[8], epoch_ns + asked_ns);
  put(&reply[16], epoch_ns + asked_ns);
  put(&reply[24], asked_ns);
  agent_inject(reply, sizeof(reply));
}

static void asked(uint8_t id)
{
  if (id == (uint8_t)TIMESTAMP && has_time) {
    asked_ns = agent_now_ns;
    agent_event_ns = agent_now_ns + ms;
    agent_event = answer;
  }
}

static void ignore(void)
{
}

static void open_session(void)
{
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  node = rcl_get_zero_initialized_node();
  CHECK(rclc_node_init_default(&node, "n", "", &support) == RCL_RET_OK);
  executor = rclc_executor_get_zero_initialized_executor();
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  guard = rcl_get_zero_initialized_guard_condition();
  CHECK(
    rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()) ==
    RCL_RET_OK);
  CHECK(rclc_executor_add_guard_condition(&executor, &guard, ignore) == RCL_RET_OK);
}

static void spin(int64_t duration_ns)
{
  const int64_t end = agent_now_ns + duration_ns;

  while (agent_now_ns < end) {
    agent_waits = 0;
    (void)rclc_executor_spin_some(&executor, (uint64_t)(end - agent_now_ns));
    rcl_reset_error();
  }
}

static rmw_uros_time_state_t state(void)
{
  rmw_uros_time_status_t found;

  CHECK(rmw_uros_time_source_status(&found) == RMW_RET_OK);
  return found.state;
}

/* The time is asked for, and the next question is due after the device sleeps. */
static void be_awake(rmw_uros_retained_t * retained)
{
  open_session();
  spin(second);
  CHECK(state() == RMW_UROS_TIME_FOLLOWING);
  CHECK(rmw_uros_sleep(rcl_context_get_rmw_context(&support.context), retained, 300) == RMW_RET_OK);
}

/* A device that is awake for less than the period has the time, not that of a reply before its sleep. */
static void test_time(void)
{
  has_time = false;
  open_session();
  spin(AWAKE_MS * ms / 2);
  CHECK(state() == RMW_UROS_TIME_UNSET);
  has_time = true;
  spin(AWAKE_MS * ms);
  CHECK(state() == RMW_UROS_TIME_FOLLOWING);
  CHECK(llabs(rmw_uros_epoch_nanos() - epoch_ns - agent_now_ns) < 5 * ms);
}

/* A task of the woken device waits already, and the other ones may call the library. */
static void test_wake(rmw_uros_retained_t * retained)
{
  xrce_client_t * client = rmw_client_instance();

  client->waiting = 1;
  locked = 0;
  CHECK(rmw_uros_wake(retained));
  CHECK(locked == 1u && client->waiting == 1u);
  ++client->time_sync.replies; /* one that came as the sleep began */
}

int main(void)
{
  rmw_uros_retained_t * retained =
    mmap(NULL, sizeof(*retained), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  int status = 1;
  pid_t before;

  CHECK(retained != MAP_FAILED);
  agent_asked = asked;
  before = fork();
  if (before == 0) {
    be_awake(retained);
    _exit(0);
  }
  CHECK(waitpid(before, &status, 0) == before && status == 0);
  test_wake(retained);
  test_time();
  CHECK(rmw_client_instance()->waiting == 1u);
  return 0;
}
