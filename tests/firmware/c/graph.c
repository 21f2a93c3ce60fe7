/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A publisher that looks at the ROS graph. `graph_report`: queries that succeeded, subscriptions that match the
 * publisher, nodes, bytes of the names of all topics with their types, and changes that the executor has seen.
 */
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rclc_executor_t executor;
static rcl_guard_condition_t changed;
static rcl_allocator_t allocator;

volatile uint32_t graph_report[5];

static void on_change(void)
{
  ++graph_report[4];
}

static bool look_at_nodes(void)
{
  rcutils_string_array_t names = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t namespaces = rcutils_get_zero_initialized_string_array();

  if (rcl_get_node_names(&node, allocator, &names, &namespaces) != RCL_RET_OK) {
    return false;
  }
  graph_report[2] = (uint32_t)names.size;
  return rcutils_string_array_fini(&names) == RCUTILS_RET_OK &&
         rcutils_string_array_fini(&namespaces) == RCUTILS_RET_OK;
}

static bool look_at_topics(void)
{
  rcl_names_and_types_t found = rcl_get_zero_initialized_names_and_types();
  size_t bytes = 0;

  if (rcl_get_topic_names_and_types(&node, &allocator, false, &found) != RCL_RET_OK) {
    return false;
  }
  for (size_t i = 0; i < found.names.size; ++i) {
    bytes += strlen(found.names.data[i]);
    for (size_t j = 0; j < found.types[i].size; ++j) {
      bytes += strlen(found.types[i].data[j]);
    }
  }
  graph_report[3] = (uint32_t)bytes;
  return rcl_names_and_types_fini(&found) == RCL_RET_OK;
}

static bool open_all(void)
{
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 1, &allocator) != RCL_RET_OK) {
    return false;
  }
  changed = *rcl_node_get_graph_guard_condition(&node);
  return rclc_executor_add_guard_condition(&executor, &changed, on_change) == RCL_RET_OK;
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  if (!open_all()) {
    return 1;
  }
  for (;;) {
    size_t count = 0;

    if (
      rcl_publisher_get_subscription_count(&publisher, &count) == RCL_RET_OK && look_at_nodes() &&
      look_at_topics()) {
      graph_report[1] = (uint32_t)count;
      ++graph_report[0];
    }
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(20));
  }
}
