/* SPDX-License-Identifier: Apache-2.0 */
/*
 * For libFuzzer: a client that is in session with an agent, and datagrams of other senders between those of the agent, while it
 * publishes, takes, sleeps and loses the session. An input is a list of actions, a byte each; the datagram of an action
 * follows as its size and its bytes.
 */
#include "port_agent.h"
#include "types.h"

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <stdlib.h>
#include <string.h>

enum { ACTIONS = 8, MESSAGE_TEXT = 8, SUBSCRIPTIONS = 2 };

typedef struct input_t {
  const uint8_t * data;
  size_t left;
} input_t;

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscriptions[SUBSCRIPTIONS];

int LLVMFuzzerTestOneInput(const uint8_t * data, size_t size);

static void expect(bool condition)
{
  if (!condition) {
    abort();
  }
}

static uint8_t next_byte(input_t * input)
{
  if (input->left == 0u) {
    return 0;
  }
  --input->left;
  return *input->data++;
}

static void inject(input_t * input)
{
  size_t size = next_byte(input);

  size = size < input->left ? size : input->left;
  agent_inject(input->data, size);
  input->data += size;
  input->left -= size;
}

static void begin(void)
{
  const rosidl_message_type_support_t * number = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_message_type_support_t * text = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);

  allocator = rcl_get_default_allocator();
  expect(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  expect(rclc_node_init_default(&node, "probe", "", &support) == RCL_RET_OK);
  expect(rclc_publisher_init_default(&publisher, &node, number, "out") == RCL_RET_OK);
  expect(rclc_subscription_init_best_effort(&subscriptions[0], &node, number, "in") == RCL_RET_OK);
  expect(rclc_subscription_init_default(&subscriptions[1], &node, text, "text") == RCL_RET_OK);
}

static void take_all(void)
{
  std_msgs__msg__Int32 number;
  char characters[MESSAGE_TEXT + 1];
  std_msgs__msg__String text = {{characters, 0, sizeof(characters)}};

  (void)rcl_take(&subscriptions[0], &number, NULL, NULL);
  if (rcl_take(&subscriptions[1], &text, NULL, NULL) == RCL_RET_OK) {
    expect(text.data.size <= MESSAGE_TEXT);
  }
  rcl_reset_error();
}

static void act(uint8_t action, input_t * input)
{
  const std_msgs__msg__Int32 number = {5};

  switch (action % ACTIONS) {
    case 0:
    case 1:
    case 2:
      inject(input);
      break;
    case 3:
      (void)rcl_publish(&publisher, &number, NULL);
      rcl_reset_error();
      break;
    case 4:
      take_all();
      break;
    case 5:
      agent_now_ns += (int64_t)next_byte(input) * 10000000;
      break;
    case 6:
      (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context)); /* makes room */
      agent_offer_number(3, action); /* the first subscription, after three publishers */
      break;
    default:
      (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
      break;
  }
}

/* Whatever came: once nobody disturbs, the session is there again and everything can be closed. */
static void end(void)
{
  rmw_context_t * context = rcl_context_get_rmw_context(&support.context);

  for (int i = 0; i < 100; ++i) {
    agent_now_ns += 50000000;
    (void)rmw_uros_spin_once(context);
  }
  expect(rmw_uros_is_connected(context));
  for (size_t i = 0; i < SUBSCRIPTIONS; ++i) {
    (void)rcl_subscription_fini(&subscriptions[i], &node);
  }
  (void)rcl_publisher_fini(&publisher, &node);
  (void)rcl_node_fini(&node);
  expect(rclc_support_fini(&support) == RCL_RET_OK);
  rcl_reset_error();
}

int LLVMFuzzerTestOneInput(const uint8_t * data, size_t size)
{
  input_t input = {data, size};

  agent_now_ns = INT64_C(0xffffff00) * 1000000;
  begin();
  while (input.left != 0u) {
    act(next_byte(&input), &input);
  }
  end();
  return 0;
}
