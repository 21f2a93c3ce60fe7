/* SPDX-License-Identifier: Apache-2.0 */
/* Publishes one message of which the callback writes PARTS_BYTES bytes, over the POSIX port. */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/u_int8_multi_array.h>

#include <stdio.h>

enum { PARTS_BYTES = 5000 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;

static void add_size(uint32_t * topic_length)
{
  *topic_length += (uint32_t)PARTS_BYTES;
}

static void write_rest(ucdrBuffer * ucdr)
{
  for (uint32_t i = 0; i < (uint32_t)PARTS_BYTES; ++i) {
    (void)ucdr_serialize_uint8_t(ucdr, (uint8_t)(i + i / 251u));
  }
}

int main(void)
{
  static uint8_t none[1];
  std_msgs__msg__UInt8MultiArray message = {0};
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  message.data.data = none;
  message.data.capacity = sizeof(none);
  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "camera", "", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, UInt8MultiArray), "frames");
  }
  if (result == RCL_RET_OK) {
    rmw_uros_set_continous_serialization_callbacks(
      rcl_publisher_get_rmw_handle(&publisher), add_size, write_rest);
    result = rcl_publish(&publisher, &message, NULL);
  }
  if (result != RCL_RET_OK) {
    printf("%s\n", rcl_get_error_string().str);
  }
  return result == RCL_RET_OK ? 0 : 1;
}
