/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The messages of measured_tasks.c with texts and sequences, each as full as the application file of test_task_texts.py
 * allows. A job publishes one of them, the text also to the subscription.
 */
#ifndef MEASURED_TEXTS_H
#define MEASURED_TEXTS_H

#include <rclc/rclc.h>
#include <sensor_msgs/msg/joint_state.h>
#include <sensor_msgs/msg/laser_scan.h>
#include <std_msgs/msg/string.h>

enum { TEXT_SIZE = 40, PLACES = 8, HEARD_EACH = 3 };
static rcl_publisher_t text_publisher;
static rcl_publisher_t joints_publisher;
static rcl_publisher_t scan_publisher;
static std_msgs__msg__String said;
static std_msgs__msg__String heard;
static sensor_msgs__msg__JointState joints;
static sensor_msgs__msg__LaserScan scan;
static uint32_t published;

static void text_fill(rosidl_runtime_c__String * text, char * storage)
{
  for (uint32_t i = 0; i < (uint32_t)TEXT_SIZE; ++i) {
    storage[i] = 'a';
  }
  text->data = storage;
  text->size = (size_t)TEXT_SIZE;
  text->capacity = (size_t)TEXT_SIZE + 1u;
}

static void numbers_fill(rosidl_runtime_c__double__Sequence * numbers, double * storage)
{
  numbers->data = storage;
  numbers->size = (size_t)PLACES;
  numbers->capacity = (size_t)PLACES;
}

static void messages_fill(void)
{
  static char texts[PLACES + 4][TEXT_SIZE + 1];
  static rosidl_runtime_c__String names[PLACES];
  static double numbers[PLACES];
  static float ranges[PLACES];

  text_fill(&said.data, texts[PLACES]);
  text_fill(&heard.data, texts[PLACES + 1]);
  text_fill(&joints.header.frame_id, texts[PLACES + 2]);
  text_fill(&scan.header.frame_id, texts[PLACES + 3]);
  for (uint32_t i = 0; i < (uint32_t)PLACES; ++i) {
    text_fill(&names[i], texts[i]);
  }
  joints.name.data = names;
  joints.name.size = (size_t)PLACES;
  joints.name.capacity = (size_t)PLACES;
  numbers_fill(&joints.position, numbers);
  numbers_fill(&joints.velocity, numbers);
  numbers_fill(&joints.effort, numbers);
  scan.ranges.data = ranges;
  scan.ranges.size = (size_t)PLACES;
  scan.ranges.capacity = (size_t)PLACES;
  scan.intensities = scan.ranges;
}

static bool publisher_init(
  rcl_publisher_t * publisher, rcl_node_t * node, const rosidl_message_type_support_t * type,
  const char * topic)
{
  return rclc_publisher_init_default(publisher, node, type, topic) == RCL_RET_OK;
}

static bool messages_init(rcl_node_t * node, rcl_subscription_t * subscription)
{
  const rosidl_message_type_support_t * text = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);

  messages_fill();
  return publisher_init(&text_publisher, node, text, "words") &&
         publisher_init(
           &joints_publisher, node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState), "joints") &&
         publisher_init(
           &scan_publisher, node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, LaserScan), "scan") &&
         rclc_subscription_init_default(subscription, node, text, "words") == RCL_RET_OK;
}

static bool messages_publish(void)
{
  const uint32_t kind = published % (uint32_t)HEARD_EACH;

  ++published;
  if (kind == 0u) {
    return rcl_publish(&joints_publisher, &joints, NULL) == RCL_RET_OK;
  }
  if (kind == 1u) {
    return rcl_publish(&scan_publisher, &scan, NULL) == RCL_RET_OK;
  }
  return rcl_publish(&text_publisher, &said, NULL) == RCL_RET_OK;
}

#endif /* MEASURED_TEXTS_H */
