/* SPDX-License-Identifier: Apache-2.0 */
/* The message of measured_tasks.c: a number. */
#ifndef MEASURED_NUMBER_H
#define MEASURED_NUMBER_H

#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

enum { HEARD_EACH = 1 }; /* one of so many messages reaches the subscription */

static rcl_publisher_t publisher;
static std_msgs__msg__Int32 said;
static std_msgs__msg__Int32 heard;
static uint32_t published;

static bool messages_init(rcl_node_t * node, rcl_subscription_t * subscription)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);

  return rclc_publisher_init_default(&publisher, node, type, "count") == RCL_RET_OK &&
         rclc_subscription_init_default(subscription, node, type, "count") == RCL_RET_OK;
}

static bool messages_publish(void)
{
  ++said.data;
  ++published;
  return rcl_publish(&publisher, &said, NULL) == RCL_RET_OK;
}

#endif /* MEASURED_NUMBER_H */
