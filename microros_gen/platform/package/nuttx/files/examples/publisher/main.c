/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Publishes a number each second: microros [device]. Waits for the agent; after an outage of the agent, the library creates
 * everything again by itself.
 */
#include <nuttx/config.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>
#include <stdio.h>

enum { PERIOD_MS = 1000 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_timer_t timer;
static rclc_executor_t executor;
static std_msgs__msg__Int32 message;

static void on_timer(rcl_timer_t * due, int64_t last_call_time)
{
  (void)due;
  (void)last_call_time;
  if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
    ++message.data;
  }
}

static bool entities_create(rcl_allocator_t * allocator, rcl_init_options_t * options, const char * device)
{
  rmw_init_options_t * rmw_options = rcl_init_options_get_rmw_init_options(options);

  return rmw_uros_options_set_serial_device(device, rmw_options) == RMW_RET_OK &&
         rclc_support_init_with_options(&support, 0, NULL, options, allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "nuttx_node", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_default(
           &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "nuttx_publisher") ==
           RCL_RET_OK &&
         rclc_timer_init_default(&timer, &support, RCL_MS_TO_NS(PERIOD_MS), on_timer) == RCL_RET_OK &&
         rclc_executor_init(&executor, &support.context, 1, allocator) == RCL_RET_OK &&
         rclc_executor_add_timer(&executor, &timer) == RCL_RET_OK;
}

static void entities_remove(void)
{
  (void)rclc_executor_fini(&executor);
  (void)rcl_timer_fini(&timer);
  (void)rcl_publisher_fini(&publisher, &node);
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

int main(int argc, char * argv[])
{
  const char * device = argc > 1 ? argv[1] : "/dev/ttyS1";
  rcl_allocator_t allocator = rcl_get_default_allocator();
  bool is_ready = false;

  while (!is_ready) {
    rcl_init_options_t options = rcl_get_zero_initialized_init_options();

    is_ready =
      rcl_init_options_init(&options, allocator) == RCL_RET_OK && entities_create(&allocator, &options, device);
    if (!is_ready) {
      entities_remove();
      rclc_sleep_ms(PERIOD_MS);
    }
    (void)rcl_init_options_fini(&options);
  }
  (void)printf("connected\n");
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(PERIOD_MS));
  }
}
