/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The measured way of a message from a publisher to a subscription of the same image: publish, and take. With
 * MEASURED_AGENT over the agent, which returns the sample in between. Done several times: the last one takes in what the
 * agent said to the one before.
 */
#include "measured.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>

enum { READER = 1, TIMES = 8 };

static void check(bool holds)
{
  if (!holds) {
    finish();
  }
}

/* The sample comes back from the agent. Not inlined: the work of the agent does not count. */
__attribute__((noinline)) static void agent_returns(int32_t value)
{
#ifdef MEASURED_AGENT
  uint8_t data[16] = {0x81, RELIABLE, 0, 0, 0x09, 0x01, 8, 0};

  data[2] = (uint8_t)(output_sequence[1] & 0xffu);
  data[3] = (uint8_t)(output_sequence[1] >> 8);
  ++output_sequence[1];
  put(&data[8], read_ids[READER], 4);
  data[12] = (uint8_t)value;
  answer(data, sizeof(data));
#else
  (void)value;
#endif
}

int main(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  static rclc_support_t support;
  static rcl_node_t node;
  static rcl_publisher_t publisher;
  static rcl_subscription_t subscription;
  std_msgs__msg__Int32 said = {.data = 0};
  std_msgs__msg__Int32 heard = {.data = 0};

  check(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  check(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  check(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  check(rclc_subscription_init_default(&subscription, &node, type, "count") == RCL_RET_OK);
  for (int32_t i = 0; i < TIMES; ++i) {
    check(rcl_take(&subscription, &heard, NULL, NULL) == RCL_RET_SUBSCRIPTION_TAKE_FAILED);
  }
  mark();
  mark();
  for (said.data = 1; said.data <= TIMES; ++said.data) {
    check(rcl_publish(&publisher, &said, NULL) == RCL_RET_OK);
    mark();
    agent_returns(said.data);
    mark();
    check(rcl_take(&subscription, &heard, NULL, NULL) == RCL_RET_OK && heard.data == said.data);
    mark();
  }
  finish();
}
