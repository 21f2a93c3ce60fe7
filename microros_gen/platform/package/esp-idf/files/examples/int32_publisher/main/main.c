/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes a number each second. Waits for the agent, and starts again when it is lost. */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>
#include <uros_network_interfaces.h>

#include "esp_log.h"
#include "freertos/FreeRTOS.h"
#include "freertos/task.h"
#include "sdkconfig.h"

enum { PERIOD_MS = 1000, PING_MS = 500, PINGS = 4 };

static const char * const tag = "int32_publisher";
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

static bool entities_create(rcl_allocator_t * allocator, rcl_init_options_t * options)
{
  rmw_init_options_t * rmw_options = rcl_init_options_get_rmw_init_options(options);

  return rmw_uros_options_set_udp_address(
           CONFIG_MICRO_ROS_AGENT_IP, CONFIG_MICRO_ROS_AGENT_PORT, rmw_options) == RMW_RET_OK &&
         rclc_support_init_with_options(&support, 0, NULL, options, allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "esp32_int32_publisher", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_default(
           &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32),
           "freertos_int32_publisher") == RCL_RET_OK &&
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

static void micro_ros_task(void * unused)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  (void)unused;
  for (;;) {
    rcl_init_options_t options = rcl_get_zero_initialized_init_options();

    if (rcl_init_options_init(&options, allocator) == RCL_RET_OK && entities_create(&allocator, &options)) {
      ESP_LOGI(tag, "connected");
      while (rmw_uros_ping_agent(PING_MS, PINGS) == RMW_RET_OK) {
        (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(PERIOD_MS));
      }
      ESP_LOGI(tag, "agent lost");
    }
    entities_remove();
    (void)rcl_init_options_fini(&options);
    vTaskDelay(pdMS_TO_TICKS(PERIOD_MS));
  }
}

void app_main(void)
{
#ifdef CONFIG_MICRO_ROS_ESP_NETIF_WLAN
  ESP_ERROR_CHECK(uros_network_interface_initialize());
#endif
  (void)xTaskCreate(
    micro_ros_task, "uros_task", CONFIG_MICRO_ROS_APP_STACK, NULL, CONFIG_MICRO_ROS_APP_TASK_PRIO, NULL);
}
