/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes Int32, encodes and decodes messages under callgrind; argv[1] says which (see instructions.py). */
#include <microros/message_type.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <geometry_msgs/msg/twist_stamped.h>
#include <geometry_msgs/msg/detail/twist_stamped__storage.h>
#include <sensor_msgs/msg/imu.h>
#include <sensor_msgs/msg/detail/imu__storage.h>
#include <sensor_msgs/msg/joint_state.h>
#include <sensor_msgs/msg/detail/joint_state__storage.h>
#include <sensor_msgs/msg/laser_scan.h>
#include <sensor_msgs/msg/detail/laser_scan__storage.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>
#include <std_msgs/msg/detail/string__storage.h>

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { PUBLISHES = 200, ENCODES = 1000 };

static uint8_t body[4096];
static uint32_t written;

/* The counted function: callgrind collects inside it only. */
uint32_t bench_encode(const rosidl_message_type_support_t * support, const void * message);

uint32_t bench_encode(const rosidl_message_type_support_t * support, const void * message)
{
  const microros_message_type_t * const type = (const microros_message_type_t *)support->data;
  cdr_fault_t fault;
  return type->encode(message, body, &fault);
}

bool bench_decode(const rosidl_message_type_support_t * support, uint32_t size, void * message);

bool bench_decode(const rosidl_message_type_support_t * support, uint32_t size, void * message)
{
  const microros_message_type_t * const type = (const microros_message_type_t *)support->data;
  cdr_fault_t fault;
  return type->decode(body, size, false, message, &fault);
}

static int encode_all(const char * what)
{
  static std_msgs__msg__Int32 number;
  static std_msgs__msg__String text;
  static std_msgs__msg__String__Storage text_storage;
  static sensor_msgs__msg__Imu imu;
  static sensor_msgs__msg__Imu__Storage imu_storage;
  static sensor_msgs__msg__JointState joints;
  static sensor_msgs__msg__JointState__Storage joints_storage;
  static sensor_msgs__msg__LaserScan scan;
  static sensor_msgs__msg__LaserScan__Storage scan_storage;
  static geometry_msgs__msg__TwistStamped twist;
  static geometry_msgs__msg__TwistStamped__Storage twist_storage;
  const rosidl_message_type_support_t * support = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  void * message = &number;
  bool read = true;

  if (strcmp(what, "String") == 0) {
    std_msgs__msg__String__bind(&text, &text_storage);
    memset(text.data.data, 'x', 32);
    text.data.size = 32;
    support = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);
    message = &text;
  } else if (strcmp(what, "Imu") == 0) {
    sensor_msgs__msg__Imu__bind(&imu, &imu_storage);
    memcpy(imu.header.frame_id.data, "imu", 4);
    imu.header.frame_id.size = 3;
    support = ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, Imu);
    message = &imu;
  } else if (strcmp(what, "JointState") == 0) {
    sensor_msgs__msg__JointState__bind(&joints, &joints_storage);
    for (size_t i = 0; i < 6; ++i) {
      memcpy(joints.name.data[i].data, "joint_1", 8);
      joints.name.data[i].size = 7;
    }
    joints.name.size = 6;
    joints.position.size = 6;
    joints.velocity.size = 6;
    joints.effort.size = 6;
    support = ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState);
    message = &joints;
  } else if (strcmp(what, "LaserScan") == 0) {
    sensor_msgs__msg__LaserScan__bind(&scan, &scan_storage);
    scan.ranges.size = 360;
    support = ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, LaserScan);
    message = &scan;
  } else if (strcmp(what, "TwistStamped") == 0) {
    geometry_msgs__msg__TwistStamped__bind(&twist, &twist_storage);
    support = ROSIDL_GET_MSG_TYPE_SUPPORT(geometry_msgs, msg, TwistStamped);
    message = &twist;
  }
  for (int i = 0; i < ENCODES; ++i) {
    written = bench_encode(support, message);
  }
  for (int i = 0; i < ENCODES; ++i) {
    read = read && bench_decode(support, written, message);
  }
  printf("%d calls, %u bytes\n", ENCODES, (unsigned)written);
  return written != 0u && read ? 0 : 1;
}

static int publish_all(bool reliable)
{
  static rclc_support_t context;
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  static std_msgs__msg__Int32 message;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  int accepted = 0;
  rcl_ret_t result = rclc_support_init(&context, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "bench", "", &context);
  }
  if (result == RCL_RET_OK && reliable) {
    result = rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "reliable");
  } else if (result == RCL_RET_OK) {
    result = rclc_publisher_init_best_effort(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "best_effort");
  }
  if (result != RCL_RET_OK) {
    fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 1;
  }
  while (accepted < PUBLISHES) {
    ++message.data;
    if (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
      ++accepted;
    } else {
      rcl_reset_error();
    }
    rclc_sleep_ms(2); /* the acknowledgement comes meanwhile: the stream has room */
  }
  printf("%d calls\n", accepted);
  return 0;
}

int main(int argc, char ** argv)
{
  if (argc != 2) {
    return 2;
  }
  if (strcmp(argv[1], "best_effort") == 0 || strcmp(argv[1], "reliable") == 0) {
    return publish_all(argv[1][0] == 'r');
  }
  return encode_all(argv[1]);
}
