/* SPDX-License-Identifier: Apache-2.0 */
/* The messages, filled through the same members for both sides: compiled once with the headers of each. */
#include <geometry_msgs/msg/twist_stamped.h>
#include <sensor_msgs/msg/imu.h>
#include <sensor_msgs/msg/joint_state.h>
#include <sensor_msgs/msg/laser_scan.h>
#include <sensor_msgs/msg/point_cloud2.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>

#include <stddef.h>
#include <string.h>

#include "codec.h"

#ifdef CODEC_FAST_CDR
/* The target's memory is the peer's own affair: it allocates while it decodes. */
#define HANDLE_NAME(package, type) \
  rosidl_typesupport_fastrtps_c__get_message_type_support_handle__##package##__msg__##type
#define HANDLE(package, type) HANDLE_NAME(package, type)()
const rosidl_message_type_support_t * HANDLE_NAME(std_msgs, Int32)(void);
const rosidl_message_type_support_t * HANDLE_NAME(std_msgs, String)(void);
const rosidl_message_type_support_t * HANDLE_NAME(sensor_msgs, Imu)(void);
const rosidl_message_type_support_t * HANDLE_NAME(sensor_msgs, JointState)(void);
const rosidl_message_type_support_t * HANDLE_NAME(sensor_msgs, LaserScan)(void);
const rosidl_message_type_support_t * HANDLE_NAME(sensor_msgs, PointCloud2)(void);
const rosidl_message_type_support_t * HANDLE_NAME(geometry_msgs, TwistStamped)(void);
#define TARGET(package, type, target) (void)package##__msg__##type##__init(target)
#define FIXED_TARGET(package, type, target) TARGET(package, type, target)
#else
#include <geometry_msgs/msg/detail/twist_stamped__storage.h>
#include <sensor_msgs/msg/detail/imu__storage.h>
#include <sensor_msgs/msg/detail/joint_state__storage.h>
#include <sensor_msgs/msg/detail/laser_scan__storage.h>
#include <sensor_msgs/msg/detail/point_cloud2__storage.h>
#include <std_msgs/msg/detail/string__storage.h>
#define HANDLE(package, type) ROSIDL_GET_MSG_TYPE_SUPPORT(package, msg, type)
#define TARGET(package, type, target) \
  do { \
    static package##__msg__##type##__Storage storage; \
    package##__msg__##type##__bind(target, &storage); \
  } while (false)
#define FIXED_TARGET(package, type, target) (void)(target)
#endif

enum { JOINTS = 6, RANGES = 360, POINTS = 4064, POINT_SIZE = 16, POINT_FIELDS = 4 };

uint8_t codec_buffer[CODEC_BUFFER_SIZE];

/** Set the string to these characters, which stay where they are. */
static void set_text(rosidl_runtime_c__String * text, char * characters)
{
  text->data = characters;
  text->size = strlen(characters);
  text->capacity = text->size + 1u;
}

static void set_stamp(std_msgs__msg__Header * header, char * frame)
{
  header->stamp.sec = 1700000000;
  header->stamp.nanosec = 123456789u;
  set_text(&header->frame_id, frame);
}

/** Set a sequence of doubles to `count` numbers in `room`. */
static void set_doubles(rosidl_runtime_c__double__Sequence * sequence, double * room, size_t count)
{
  for (size_t i = 0; i < count; ++i) {
    room[i] = 0.25 * (double)(i + 1u);
  }
  sequence->data = room;
  sequence->size = count;
  sequence->capacity = count;
}

static codec_case_t int32_case(void)
{
  static std_msgs__msg__Int32 message, target;
  message.data = -123456;
  FIXED_TARGET(std_msgs, Int32, &target);
  return (codec_case_t){"Int32", HANDLE(std_msgs, Int32), &message, &target};
}

static codec_case_t string_case(void)
{
  static char characters[] = "thirty-two characters, no more.!";
  static std_msgs__msg__String message, target;
  set_text(&message.data, characters);
  TARGET(std_msgs, String, &target);
  return (codec_case_t){"String", HANDLE(std_msgs, String), &message, &target};
}

static codec_case_t imu_case(void)
{
  static char frame[] = "imu";
  static sensor_msgs__msg__Imu message, target;
  set_stamp(&message.header, frame);
  message.orientation.w = 1.0;
  message.angular_velocity.z = 0.5;
  message.linear_acceleration.z = 9.81;
  for (size_t i = 0; i < 9u; ++i) {
    message.orientation_covariance[i] = 0.001 * (double)i;
  }
  TARGET(sensor_msgs, Imu, &target);
  return (codec_case_t){"Imu", HANDLE(sensor_msgs, Imu), &message, &target};
}

static codec_case_t joint_state_case(void)
{
  static char frame[] = "";
  static char names[JOINTS][8] = {"joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6"};
  static rosidl_runtime_c__String texts[JOINTS];
  static double positions[JOINTS], velocities[JOINTS], efforts[JOINTS];
  static sensor_msgs__msg__JointState message, target;
  set_stamp(&message.header, frame);
  for (size_t i = 0; i < (size_t)JOINTS; ++i) {
    set_text(&texts[i], names[i]);
  }
  message.name.data = texts;
  message.name.size = JOINTS;
  message.name.capacity = JOINTS;
  set_doubles(&message.position, positions, JOINTS);
  set_doubles(&message.velocity, velocities, JOINTS);
  set_doubles(&message.effort, efforts, JOINTS);
  TARGET(sensor_msgs, JointState, &target);
  return (codec_case_t){"JointState", HANDLE(sensor_msgs, JointState), &message, &target};
}

static codec_case_t laser_scan_case(void)
{
  static char frame[] = "laser";
  static float ranges[RANGES];
  static sensor_msgs__msg__LaserScan message, target;
  set_stamp(&message.header, frame);
  for (size_t i = 0; i < (size_t)RANGES; ++i) {
    ranges[i] = 0.01f * (float)i;
  }
  message.ranges.data = ranges;
  message.ranges.size = RANGES;
  message.ranges.capacity = RANGES;
  TARGET(sensor_msgs, LaserScan, &target);
  return (codec_case_t){"LaserScan", HANDLE(sensor_msgs, LaserScan), &message, &target};
}

static codec_case_t twist_stamped_case(void)
{
  static char frame[] = "base";
  static geometry_msgs__msg__TwistStamped message, target;
  set_stamp(&message.header, frame);
  message.twist.linear.x = 0.5;
  message.twist.angular.z = -0.25;
  TARGET(geometry_msgs, TwistStamped, &target);
  return (codec_case_t){"TwistStamped", HANDLE(geometry_msgs, TwistStamped), &message, &target};
}

static codec_case_t point_cloud2_case(void)
{
  static char frame[] = "camera";
  static char names[POINT_FIELDS][10] = {"x", "y", "z", "intensity"};
  static sensor_msgs__msg__PointField fields[POINT_FIELDS];
  static uint8_t points[POINTS * POINT_SIZE];
  static sensor_msgs__msg__PointCloud2 message, target;
  set_stamp(&message.header, frame);
  for (size_t i = 0; i < (size_t)POINT_FIELDS; ++i) {
    set_text(&fields[i].name, names[i]);
    fields[i].offset = (uint32_t)(4u * i);
    fields[i].datatype = 7u;
    fields[i].count = 1u;
  }
  for (size_t i = 0; i < sizeof(points); ++i) {
    points[i] = (uint8_t)(i * 7u);
  }
  message.fields.data = fields;
  message.fields.size = POINT_FIELDS;
  message.fields.capacity = POINT_FIELDS;
  message.height = 1u;
  message.width = POINTS;
  message.point_step = POINT_SIZE;
  message.row_step = sizeof(points);
  message.data.data = points;
  message.data.size = sizeof(points);
  message.data.capacity = sizeof(points);
  TARGET(sensor_msgs, PointCloud2, &target);
  return (codec_case_t){"PointCloud2", HANDLE(sensor_msgs, PointCloud2), &message, &target};
}

const codec_case_t * codec_case(const char * name)
{
  static codec_case_t (*const make[])(void) = {int32_case,       string_case,     imu_case,
                                               joint_state_case, laser_scan_case, twist_stamped_case,
                                               point_cloud2_case};
  static codec_case_t found;
  for (size_t i = 0; i < sizeof(make) / sizeof(*make); ++i) {
    found = make[i]();
    if (strcmp(found.name, name) == 0) {
      return &found;
    }
  }
  return NULL;
}
