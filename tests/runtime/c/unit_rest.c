/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A node with parameters, log messages, logger services and a client of the graph in rclc_executor_spin, an hour of which nothing
 * comes. Prints how often it woke up. The application files are those of test_whole_node_rests.py.
 */
#include "port_agent.h"
#include "unit.h"

#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_parameter/rclc_parameter.h>

#include <inttypes.h>

enum { HANDLES = 12 };

static const int64_t second_ns = 1000000000;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_parameter_server_t server;

static bool on_parameter(const Parameter * before, const Parameter * after, void * context)
{
  (void)before;
  (void)after;
  (void)context;
  return true;
}

static void end(void)
{
  (void)printf("woke %" PRIu32 "\n", agent_waits);
  exit(0);
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, HANDLES, &allocator) == RCL_RET_OK);
  CHECK(rclc_parameter_server_init_default(&server, &node) == RCL_RET_OK);
  CHECK(rclc_executor_add_parameter_server(&executor, &server, on_parameter) == RCL_RET_OK);
  CHECK(rclc_executor_spin_some(&executor, (uint64_t)(10 * second_ns)) == RCL_RET_OK);
  agent_waits = 0;
  agent_event = end;
  agent_event_ns = agent_now_ns + 3600 * second_ns;
  return (int)rclc_executor_spin(&executor);
}
