/* SPDX-License-Identifier: Apache-2.0 */
/* Calls of a parameter server, for tests/bench/parameters.py: prints how many calls there were of what is counted. */
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rclc_parameter/rclc_parameter.h>
#include <rmw_microros/rmw_microros.h>

#include <stdio.h>

enum { CALLS = 20, SPINS = 100 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_parameter_server_t server;

/* Lets the agent acknowledge the event, so that each set finds room. */
static void settle(void)
{
  for (int i = 0; i < SPINS; ++i) {
    (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
    rclc_sleep_ms(1);
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  int64_t value = 0;

  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "", &support) != RCL_RET_OK ||
    rclc_parameter_server_init_default(&server, &node) != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 1;
  }
  for (int i = 0; i < 4; ++i) {
    const char name[] = {'a', (char)('0' + i), '\0'};

    if (rclc_add_parameter(&server, name, RCLC_PARAMETER_INT) != RCL_RET_OK) {
      return 1;
    }
    settle();
  }
  for (int i = 0; i < CALLS; ++i) {
    if (
      rclc_parameter_set_int(&server, "a3", i) != RCL_RET_OK ||
      rclc_parameter_get_int(&server, "a3", &value) != RCL_RET_OK || value != i) {
      return 1;
    }
    settle();
  }
  (void)printf("%d calls\n", CALLS);
  return 0;
}
