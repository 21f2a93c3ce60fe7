/* SPDX-License-Identifier: Apache-2.0 */
/* Messages with strings and sequences as sources for micro-ROS fill them, each in another way; ends with 0 when sent. */
#include <micro_ros_utilities/string_utilities.h>
#include <micro_ros_utilities/type_utilities.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <rosidl_runtime_c/primitives_sequence_functions.h>
#include <rosidl_runtime_c/string_functions.h>
#include <sensor_msgs/msg/joint_state.h>
#include <std_msgs/msg/header.h>
#include <std_msgs/msg/int32_multi_array.h>
#include <std_msgs/msg/string.h>
#include <stdio.h>

#define JOINTS 6
#define TYPE(package, name) ROSIDL_GET_MSG_TYPE_SUPPORT(package, msg, name)
#define CHECK(condition) \
  do { \
    if (!(condition)) { \
      (void)fprintf(stderr, "line %d: %s\n", __LINE__, rcl_get_error_string().str); \
      return 1; \
    } \
  } while (0)

static const char * const names[JOINTS] = {
  "base", "shoulder", "elbow", "wrist 1", "wrist 2", "a joint of 16 b"};
static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publishers[6];
static std_msgs__msg__String initialized, set;
static std_msgs__msg__Header header;
static std_msgs__msg__Int32MultiArray numbers;
static sensor_msgs__msg__JointState joints, arm;

static int fill(void)
{
  static int32_t buffer[4] = {1, 2, 3, -4};
  micro_ros_utilities_memory_conf_t conf = micro_ros_utilities_memory_conf_default;

  /* initialized and assigned, longer and shorter */
  CHECK(std_msgs__msg__String__init(&initialized));
  CHECK(rosidl_runtime_c__String__assign(&initialized.data, "short"));
  CHECK(rosidl_runtime_c__String__assign(&initialized.data, "a text of up to forty bytes: 29 and more"));
  CHECK(!rosidl_runtime_c__String__assign(&initialized.data, "a text of up to forty bytes: 41, refused."));
  CHECK(rcl_error_is_set() && rmw_uros_get_refused_memory() == 1u);
  rcl_reset_error();
  /* a static message without __init */
  set.data = micro_ros_string_utilities_set(set.data, "set by the utilities");
  CHECK(set.data.size != 0u);
  /* one member initialized by itself */
  CHECK(rosidl_runtime_c__String__init(&header.frame_id));
  CHECK(rosidl_runtime_c__String__assign(&header.frame_id, "map"));
  /* a buffer of the program's */
  numbers.data.data = buffer;
  numbers.data.size = 4;
  numbers.data.capacity = 4;
  /* initialized, and each sequence by itself */
  CHECK(sensor_msgs__msg__JointState__init(&joints));
  CHECK(rosidl_runtime_c__String__assign(&joints.header.frame_id, "base_link"));
  CHECK(rosidl_runtime_c__String__Sequence__init(&joints.name, JOINTS));
  CHECK(rosidl_runtime_c__double__Sequence__init(&joints.position, JOINTS));
  for (size_t i = 0; i < JOINTS; ++i) {
    CHECK(rosidl_runtime_c__String__assign(&joints.name.data[i], names[i]));
    joints.position.data[i] = (double)i / 2.0;
  }
  /* memory by the rules of the utilities */
  conf.max_string_capacity = 16;
  conf.max_basic_type_sequence_capacity = JOINTS;
  CHECK(micro_ros_utilities_create_message_memory(TYPE(sensor_msgs, JointState), &arm, conf));
  arm.header.frame_id = micro_ros_string_utilities_set(arm.header.frame_id, "arm");
  arm.effort.size = 2;
  arm.effort.data[1] = -1.5;
  arm.name.size = 1;
  arm.name.data[0] = micro_ros_string_utilities_set(arm.name.data[0], "one");
  return 0;
}

int main(void)
{
  const struct {
    const rosidl_message_type_support_t * type;
    const char * topic;
    const void * message;
  } sent[] = {
    {TYPE(std_msgs, String), "memory/initialized", &initialized},
    {TYPE(std_msgs, String), "memory/set", &set},
    {TYPE(std_msgs, Header), "memory/header", &header},
    {TYPE(std_msgs, Int32MultiArray), "memory/numbers", &numbers},
    {TYPE(sensor_msgs, JointState), "memory/joints", &joints},
    {TYPE(sensor_msgs, JointState), "memory/arm", &arm}};
  rcl_allocator_t allocator = rcl_get_default_allocator();

  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "filler", "", &support) == RCL_RET_OK);
  if (fill() != 0) {
    return 1;
  }
  for (size_t i = 0; i < 6u; ++i) {
    CHECK(rclc_publisher_init_default(&publishers[i], &node, sent[i].type, sent[i].topic) == RCL_RET_OK);
  }
  for (size_t i = 0; i < 60u * 6u; ++i) {
    CHECK(rcl_publish(&publishers[i % 6u], sent[i % 6u].message, NULL) == RCL_RET_OK);
    CHECK(rmw_uros_flush(rcl_context_get_rmw_context(&support.context), 5000) == RMW_RET_OK);
    rclc_sleep_ms(8);
  }
  sensor_msgs__msg__JointState__fini(&joints);
  CHECK(micro_ros_utilities_destroy_message_memory(
    TYPE(sensor_msgs, JointState), &arm, micro_ros_utilities_memory_conf_default));
  micro_ros_string_utilities_destroy(&set.data);
  std_msgs__msg__String__fini(&initialized);
  CHECK(rmw_uros_get_refused_memory() == 1u);
  return 0;
}
