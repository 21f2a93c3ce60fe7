/* SPDX-License-Identifier: Apache-2.0 */
/* A list of three agents: who is tried when, while the clock wraps, and days after the session was opened. */
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"
#include "port_agent.h"
#include "unit.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <string.h>

enum { MOST = 64, CREATE_CLIENT = 0, FIRST_PORT = 8888 };

static const int64_t ms = 1000000;
static const int64_t day_ms = 86400000;

typedef struct attempt_t {
  uint16_t agent;
  uint32_t at_ms;
} attempt_t;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rclc_executor_t executor;
static rcl_guard_condition_t guard;
static attempt_t attempts[MOST];
static size_t count;

static uint32_t now_ms(void)
{
  return (uint32_t)(agent_now_ns / ms);
}

/* Records each CREATE_CLIENT. */
static void record(uint8_t id)
{
  if (id == (uint8_t)CREATE_CLIENT && count < MOST) {
    attempts[count].agent = (uint16_t)(rmw_client_instance()->session.transport.port - FIRST_PORT);
    attempts[count].at_ms = now_ms();
    ++count;
  }
}

static rmw_uros_agent_t used(void)
{
  rmw_uros_agent_t agent;

  CHECK(rmw_uros_get_agent(rcl_context_get_rmw_context(&support.context), &agent) == RMW_RET_OK);
  return agent;
}

static void ignore(void)
{
}

static void open_session(void)
{
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

static void close_session(void)
{
  CHECK(rclc_executor_fini(&executor) == RCL_RET_OK);
  CHECK(rcl_guard_condition_fini(&guard) == RCL_RET_OK);
  CHECK(rcl_node_fini(&node) == RCL_RET_OK);
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
}

/* The executor waits, so that each attempt is made when it is due, and not when somebody looks. */
static void spin(int64_t milliseconds)
{
  const int64_t end = agent_now_ns + milliseconds * ms;

  while (agent_now_ns < end) {
    agent_waits = 0;
    (void)rclc_executor_spin_some(&executor, (uint64_t)(end - agent_now_ns));
    rcl_reset_error();
  }
}

/* All agents are away from now on; the search begins with the next one, and a round takes longer each time. */
static void test_schedule(uint16_t next)
{
  static const uint32_t rounds[][3] = {
    /* agent of the round, start after that of the search, attempts */
    {0, 0, 3},   {1, 300, 3},  {2, 600, 4},   /* 600 ms: as long as the search took */
    {0, 1200, 3}, {1, 1500, 3}, {2, 1800, 6}, /* 1800 ms */
    {0, 3600, 3},
  };
  size_t at = 0;

  count = 0;
  agent_silent = true;
  spin(9000);
  for (size_t i = 0; i < sizeof(rounds) / sizeof(rounds[0]); ++i) {
    for (uint32_t k = 0; k < rounds[i][2]; ++k, ++at) {
      CHECK(at < count && attempts[at].agent == (next + rounds[i][0]) % 3u);
      CHECK(k != 0u || attempts[at].at_ms - attempts[0].at_ms == rounds[i][1]);
      CHECK(attempts[at].at_ms - attempts[0].at_ms < rounds[i][1] + 1800u);
    }
  }
}

/* The agent that is tried when they are back is used; returns its index. */
static uint8_t test_return(uint8_t before, uint32_t * changes)
{
  rmw_uros_agent_t agent;

  agent_silent = false;
  spin(9000);
  CHECK(rmw_uros_is_connected(rcl_context_get_rmw_context(&support.context)));
  agent = used();
  *changes += agent.index != before ? 1u : 0u;
  CHECK(agent.port == FIRST_PORT + agent.index && agent.changes == *changes);
  CHECK(strcmp(agent.host, "127.0.0.1") == 0);
  return agent.index;
}

static void test_arguments(void)
{
  rmw_uros_agent_t agent;
  rmw_context_t * context = rcl_context_get_rmw_context(&support.context);

  CHECK(rmw_uros_get_agent(NULL, &agent) == RMW_RET_INVALID_ARGUMENT);
  CHECK(rmw_uros_get_agent(context, NULL) == RMW_RET_INVALID_ARGUMENT);
  rcl_reset_error();
}

int main(void)
{
  uint8_t index;
  uint32_t changes = 0;

  agent_asked = record;
  allocator = rcl_get_default_allocator();
  open_session();
  CHECK(used().index == 0u && used().changes == 0u);
  test_arguments();
  index = 0;
  for (int step = 0; step < 12; ++step) { /* 60 days; the first search goes over the wrap */
    test_schedule((uint16_t)((index + 1u) % 3u));
    index = test_return(index, &changes);
    agent_now_ns += 5 * day_ms * ms;
  }
  close_session();
  return 0;
}
