/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages with strings and sequences, without a heap. An arm publishes the joints that it was told to take.
 * - What is received has no buffer here: microros.yaml declares the capacities, and adding it to the executor gives it
 *   memory for them. What is larger is refused in words, and the next message is received.
 * - What is sent has a buffer of the application, laid out by micro_ros_utilities; the existing micro-ROS wants that for both.
 */
#include "../example.h"

#include <micro_ros_utilities/type_utilities.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <sensor_msgs/msg/joint_state.h>

#include <string.h>

enum { JOINTS = 6, NAME_SIZE = 17 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rclc_executor_t executor;
static sensor_msgs__msg__JointState command;
static sensor_msgs__msg__JointState state;
static uint8_t state_memory[1024];

static void give_memory(const rosidl_message_type_support_t * type)
{
  static const micro_ros_utilities_memory_rule_t rules[] = {
    {"name", JOINTS}, {"position", JOINTS}, {"name.data", NAME_SIZE}};
  micro_ros_utilities_memory_conf_t conf = micro_ros_utilities_memory_conf_default;

  conf.max_string_capacity = NAME_SIZE;      /* of what no rule names: the frame_id */
  conf.max_basic_type_sequence_capacity = 1; /* the velocities and efforts, which stay empty */
  conf.rules = rules;
  conf.n_rules = sizeof(rules) / sizeof(rules[0]);
  (void)printf(
    "the state takes %u bytes of memory\n", (unsigned)micro_ros_utilities_get_static_size(type, conf));
  if (!micro_ros_utilities_create_static_message_memory(
        type, &state, conf, state_memory, sizeof(state_memory))) {
    example_check(RCL_RET_ERROR, "memory of the state");
  }
}

static void take_command(const void * message)
{
  const sensor_msgs__msg__JointState * told = message;

  state.header.stamp = told->header.stamp;
  state.name.size = told->name.size;
  for (size_t i = 0; i < told->name.size; ++i) {
    state.name.data[i].size = told->name.data[i].size;
    (void)memcpy(state.name.data[i].data, told->name.data[i].data, told->name.data[i].size + 1u);
  }
  state.position.size = told->position.size;
  for (size_t i = 0; i < told->position.size; ++i) {
    state.position.data[i] = told->position.data[i];
  }
  (void)example_tell(rcl_publish(&publisher, &state, NULL), "publish");
}

int main(void)
{
  const rosidl_message_type_support_t * joints = ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  give_memory(joints);
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "arm", "", &support), "node");
  example_check(rclc_publisher_init_default(&publisher, &node, joints, "joint_states"), "publisher");
  example_check(
    rclc_subscription_init_default(&subscription, &node, joints, "joint_commands"), "subscription");

  executor = rclc_executor_get_zero_initialized_executor();
  example_check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  example_check(
    rclc_executor_add_subscription(&executor, &subscription, &command, take_command, ON_NEW_DATA),
    "add subscription");
  while (example_runs()) {
    (void)example_tell(rclc_executor_spin_some(&executor, RCL_MS_TO_NS(100)), "spin");
  }

  example_check(rclc_executor_fini(&executor), "end of the executor");
  example_check(rcl_subscription_fini(&subscription, &node), "end of the subscription");
  example_check(rcl_publisher_fini(&publisher, &node), "end of the publisher");
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
