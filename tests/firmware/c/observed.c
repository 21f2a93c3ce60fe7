/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A publisher whose matches and misfits the graph server reports, and a transform with the agent's time. `observed_report`:
 * matched endpoints in total and now, incompatible ones in total, the policy of the last one, and transforms that were sent.
 */
#include <rcl/event.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc/stamp.h>
#include <rclc_tf/rclc_tf.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>

enum { SYNC_MS = 1000, STEP_MS = 50 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_event_t matched;
static rcl_event_t incompatible;
static rclc_executor_t executor;
static rcl_guard_condition_t changed;
static rclc_tf_broadcaster_t broadcaster;
static geometry_msgs__msg__TransformStamped transform;
static rcl_clock_t wall_clock;
static rcl_allocator_t allocator;
static char odom[] = "odom";
static char base[] = "base_link";

volatile uint32_t observed_report[5];

static void on_change(void)
{
}

static bool open_events(void)
{
  matched = rcl_get_zero_initialized_event();
  incompatible = rcl_get_zero_initialized_event();
  return rcl_publisher_event_init(&matched, &publisher, RCL_PUBLISHER_MATCHED) == RCL_RET_OK &&
         rcl_publisher_event_init(&incompatible, &publisher, RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS) ==
           RCL_RET_OK;
}

static bool open_transforms(void)
{
  if (
    rclc_tf_broadcaster_init(&broadcaster, &node) != RCL_RET_OK ||
    !geometry_msgs__msg__TransformStamped__init(&transform)) {
    return false;
  }
  transform.transform.translation.x = 0.25;
  return rcl_clock_init(RCL_SYSTEM_TIME, &wall_clock, &allocator) == RCL_RET_OK &&
         rclc_tf_set_frames(&transform, odom, base) == RCL_RET_OK;
}

static bool open_all(void)
{
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "device", "arm", &support) != RCL_RET_OK ||
    rclc_publisher_init_best_effort(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") != RCL_RET_OK ||
    rclc_executor_init(&executor, &support.context, 1, &allocator) != RCL_RET_OK) {
    return false;
  }
  changed = *rcl_node_get_graph_guard_condition(&node);
  return rclc_executor_add_guard_condition(&executor, &changed, on_change) == RCL_RET_OK && open_events() &&
         open_transforms();
}

static void look_at_events(void)
{
  rmw_matched_status_t status;
  rmw_offered_qos_incompatible_event_status_t other;

  if (rcl_take_event(&matched, &status) == RCL_RET_OK) {
    observed_report[0] = (uint32_t)status.total_count;
    observed_report[1] = (uint32_t)status.current_count;
  }
  if (rcl_take_event(&incompatible, &other) == RCL_RET_OK) {
    observed_report[2] = (uint32_t)other.total_count;
    observed_report[3] = (uint32_t)other.last_policy_kind;
  }
}

static void send_transform(void)
{
  if (rclc_stamp(&wall_clock, &transform.header.stamp.sec, &transform.header.stamp.nanosec) != RCL_RET_OK) {
    (void)rmw_uros_sync_session(SYNC_MS);
  } else if (rclc_tf_broadcaster_send(&broadcaster, &transform, 1) == RCL_RET_OK) {
    observed_report[4] = observed_report[4] + 1u;
  } else {
    /* the stream is full: the next one */
  }
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  if (!open_all()) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(STEP_MS));
    look_at_events();
    send_transform();
  }
}
