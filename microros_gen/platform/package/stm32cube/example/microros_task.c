/* SPDX-License-Identifier: Apache-2.0 */
/* A task that waits for the agent, then publishes a number each second. */
#include "main.h"

#include <cubemx_transport.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

enum { PERIOD_MS = 1000, PING_MS = 500 };

extern UART_HandleTypeDef huart3; /* the line to the agent, from main.c or usart.c of STM32CubeMX */

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

static bool entities_create(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "cubemx_node", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_default(
           &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "cubemx_publisher") ==
           RCL_RET_OK &&
         rclc_timer_init_default(&timer, &support, RCL_MS_TO_NS(PERIOD_MS), on_timer) == RCL_RET_OK &&
         rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK &&
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

/* The default task of STM32CubeMX. Without FreeRTOS, main calls it; it does not return. */
void StartDefaultTask(void * argument)
{
  bool is_ready = false;

  (void)argument;
  (void)rmw_uros_set_custom_transport(
    true, &huart3, cubemx_transport_open, cubemx_transport_close, cubemx_transport_write,
    cubemx_transport_read);
  while (!is_ready) {
    is_ready = rmw_uros_ping_agent(PING_MS, 1) == RMW_RET_OK && entities_create();
    if (!is_ready) {
      entities_remove();
    }
  }
  for (;;) { /* after an outage of the agent, the library creates everything again by itself */
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(PERIOD_MS));
  }
}
