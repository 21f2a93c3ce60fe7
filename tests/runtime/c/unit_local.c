/* SPDX-License-Identifier: Apache-2.0 */
/* Messages between endpoints of one image: the application file is that of tests/components/test_local_delivery.py. */
#include "port_agent.h"
#include "unit.h"

#include <example_interfaces/msg/w_string.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcl/wait.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <sensor_msgs/msg/joint_state.h>
#include <std_msgs/msg/int32.h>

#include <string.h>

/* Writers come first; readers in the order of the file. */
enum { WRITERS = 5, MIXED_AT = WRITERS + 3, COUNT_SLOTS = 3, OTHER_SLOTS = 5 };

static const int64_t ms = 1000000;

static rcl_allocator_t allocator;
static rclc_support_t support;
static rcl_node_t node;
static rcl_node_t other_node;
static rcl_publisher_t count;
static rcl_publisher_t joints;
static rcl_publisher_t wide;
static rcl_publisher_t mixed;
static rcl_publisher_t shout;
static rcl_subscription_t count_heard;
static rcl_subscription_t count_of_other;
static rcl_subscription_t joints_heard;
static rcl_subscription_t wide_heard;
static rcl_subscription_t mixed_heard;
static rcl_subscription_t shout_heard;

static void publish(const rcl_publisher_t * publisher, int32_t value)
{
  const std_msgs__msg__Int32 message = {.data = value};

  CHECK(rcl_publish(publisher, &message, NULL) == RCL_RET_OK);
}

static bool takes(const rcl_subscription_t * subscription, int32_t value, rmw_message_info_t * info)
{
  std_msgs__msg__Int32 message = {.data = 0};

  CHECK(rcl_take(subscription, &message, info, NULL) == RCL_RET_OK);
  if (message.data != value) {
    (void)fprintf(stderr, "%d instead of %d\n", (int)message.data, (int)value);
  }
  return message.data == value;
}

static bool is_empty(const rcl_subscription_t * subscription)
{
  std_msgs__msg__Int32 message;

  return rcl_take(subscription, &message, NULL, NULL) == RCL_RET_SUBSCRIPTION_TAKE_FAILED;
}

static uint32_t dropped(const rcl_subscription_t * subscription)
{
  rmw_uros_subscription_statistics_t statistics;

  CHECK(
    rmw_uros_get_subscription_statistics(rcl_subscription_get_rmw_handle(subscription), &statistics) ==
    RMW_RET_OK);
  return statistics.dropped;
}

static void subscribe_to_count(void)
{
  CHECK(
    rclc_subscription_init_default(
      &count_heard, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "count") == RCL_RET_OK);
}

static void open(void)
{
  const rosidl_message_type_support_t * number = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_message_type_support_t * joint = ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState);
  const rosidl_message_type_support_t * text = ROSIDL_GET_MSG_TYPE_SUPPORT(example_interfaces, msg, WString);

  allocator = rcl_get_default_allocator();
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&other_node, "other", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&count, &node, number, "count") == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&joints, &node, joint, "joints") == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&wide, &node, text, "wide") == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&mixed, &node, number, "mixed") == RCL_RET_OK);
  CHECK(rclc_publisher_init_best_effort(&shout, &node, number, "shout") == RCL_RET_OK);
  subscribe_to_count();
  CHECK(rclc_subscription_init_default(&joints_heard, &node, joint, "joints") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&wide_heard, &node, text, "wide") == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&mixed_heard, &node, number, "mixed") == RCL_RET_OK);
  CHECK(rclc_subscription_init_best_effort(&shout_heard, &node, number, "shout") == RCL_RET_OK);
  CHECK(rclc_subscription_init_default(&count_of_other, &other_node, number, "/count") == RCL_RET_OK);
}

/* Each subscription has its own queue, which keeps the last messages, in order. */
static void test_order(void)
{
  for (int32_t value = 1; value <= OTHER_SLOTS; ++value) {
    publish(&count, value);
  }
  CHECK(dropped(&count_heard) == OTHER_SLOTS - COUNT_SLOTS && dropped(&count_of_other) == 0u);
  for (int32_t value = OTHER_SLOTS - COUNT_SLOTS + 1; value <= OTHER_SLOTS; ++value) {
    CHECK(takes(&count_heard, value, NULL));
  }
  CHECK(is_empty(&count_heard));
  for (int32_t value = 1; value <= OTHER_SLOTS; ++value) {
    CHECK(takes(&count_of_other, value, NULL));
  }
  CHECK(is_empty(&count_of_other));
}

/* The ring goes round at every fill level, and further than a counter of 16 bits. */
static void test_wrap(void)
{
  int32_t next = 0;
  int32_t first = 0;

  for (uint32_t round = 0; round < 70000u; ++round) {
    const int32_t more = 1 + (int32_t)(round % COUNT_SLOTS);

    for (int32_t i = 0; i < more; ++i) {
      publish(&count, next++);
    }
    while (first != next) {
      CHECK(takes(&count_heard, first++, NULL));
    }
    CHECK(is_empty(&count_heard));
  }
  while (!is_empty(&count_of_other)) {
  }
}

/* Times are right over the wrap of milliseconds, shortly after which the unit begins. */
static void test_info(void)
{
  const int64_t before = INT64_C(0xfffffffe) * ms;
  rmw_message_info_t info;

  CHECK(agent_now_ns < before);
  agent_now_ns = before;
  publish(&count, 1);
  agent_now_ns = before + 7 * ms;
  agent_epoch_ns = INT64_C(1700000000000) * ms;
  CHECK(takes(&count_heard, 1, &info));
  CHECK(info.from_intra_process && info.source_timestamp == agent_epoch_ns - 7 * ms);
  CHECK(info.received_timestamp == info.source_timestamp);
  CHECK(info.publication_sequence_number == RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED);
  CHECK(takes(&count_of_other, 1, NULL));
  agent_epoch_ns = 0;
  publish(&count, 2);
  CHECK(takes(&count_heard, 2, &info) && info.from_intra_process && info.source_timestamp == 0);
  CHECK(takes(&count_of_other, 2, NULL));
}

typedef struct joint_buffers_t {
  char frame[21];
  rosidl_runtime_c__String names[2];
  char texts[2][21];
  double positions[2];
} joint_buffers_t;

static void bind_joints(sensor_msgs__msg__JointState * message, joint_buffers_t * buffers)
{
  (void)memset(message, 0, sizeof(*message));
  (void)memset(buffers, 0, sizeof(*buffers));
  message->header.frame_id.data = buffers->frame;
  message->header.frame_id.capacity = sizeof(buffers->frame);
  message->name.data = buffers->names;
  message->name.capacity = 2;
  for (size_t i = 0; i < 2u; ++i) {
    buffers->names[i].data = buffers->texts[i];
    buffers->names[i].capacity = sizeof(buffers->texts[i]);
  }
  message->position.data = buffers->positions;
  message->position.capacity = 2;
}

static void set_text(rosidl_runtime_c__String * text, const char * words)
{
  text->size = strlen(words);
  (void)memcpy(text->data, words, text->size + 1u);
}

/* The queue has its own memory: what the program does with its message afterwards changes nothing. */
static void test_ownership(void)
{
  sensor_msgs__msg__JointState message;
  sensor_msgs__msg__JointState heard;
  joint_buffers_t buffers;
  joint_buffers_t other;

  bind_joints(&message, &buffers);
  bind_joints(&heard, &other);
  message.header.stamp.sec = 5;
  set_text(&message.header.frame_id, "base");
  set_text(&buffers.names[0], "left");
  set_text(&buffers.names[1], "right");
  message.name.size = 2;
  message.position.size = 2;
  buffers.positions[1] = 0.5;
  CHECK(rcl_publish(&joints, &message, NULL) == RCL_RET_OK);
  (void)memset(&buffers, 'x', sizeof(buffers));
  (void)memset(&message, 0, sizeof(message));
  CHECK(rcl_publish(&joints, &message, NULL) == RCL_RET_OK); /* no string has data: all are empty */
  CHECK(rcl_take(&joints_heard, &heard, NULL, NULL) == RCL_RET_OK);
  CHECK(heard.header.stamp.sec == 5 && strcmp(heard.header.frame_id.data, "base") == 0);
  CHECK(heard.name.size == 2u && heard.name.data == other.names);
  CHECK(strcmp(other.texts[0], "left") == 0 && strcmp(other.texts[1], "right") == 0);
  CHECK(heard.position.size == 2u && heard.position.data == other.positions && other.positions[1] == 0.5);
  CHECK(rcl_take(&joints_heard, &heard, NULL, NULL) == RCL_RET_OK);
  CHECK(heard.header.frame_id.size == 0u && other.frame[0] == '\0' && heard.name.size == 0u);
  CHECK(heard.velocity.size == 0u && heard.velocity.data == NULL);
}

static bool says(const char * words)
{
  const bool found = strstr(rcl_get_error_string().str, words) != NULL;

  if (!found) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
  }
  rcl_reset_error();
  return found;
}

/* A message above its limits is refused as on the way to the agent; one without room at its destination is gone. */
static void test_limits(void)
{
  sensor_msgs__msg__JointState message;
  sensor_msgs__msg__JointState heard;
  joint_buffers_t buffers;
  joint_buffers_t other;

  bind_joints(&message, &buffers);
  bind_joints(&heard, &other);
  message.header.frame_id.size = 21;
  CHECK(rcl_publish(&joints, &message, NULL) == RCL_RET_ERROR && says("frame_id"));
  CHECK(rcl_take(&joints_heard, &heard, NULL, NULL) == RCL_RET_SUBSCRIPTION_TAKE_FAILED);
  message.header.frame_id.size = 20;
  (void)memset(buffers.frame, 'f', 20);
  CHECK(rcl_publish(&joints, &message, NULL) == RCL_RET_OK);
  heard.header.frame_id.capacity = 20; /* no room for the terminator */
  CHECK(rcl_take(&joints_heard, &heard, NULL, NULL) == RCL_RET_ERROR && says("too little room"));
  CHECK(rcl_take(&joints_heard, &heard, NULL, NULL) == RCL_RET_SUBSCRIPTION_TAKE_FAILED);
  message.position.size = 2;
  CHECK(rcl_publish(&joints, &message, NULL) == RCL_RET_OK);
  heard.header.frame_id.capacity = 21;
  heard.position.capacity = 1;
  CHECK(rcl_take(&joints_heard, &heard, NULL, NULL) == RCL_RET_ERROR && says("too little room"));
  heard.position.capacity = 2;
  CHECK(rcl_publish(&joints, &message, NULL) == RCL_RET_OK);
  CHECK(rcl_take(&joints_heard, &heard, NULL, NULL) == RCL_RET_OK);
  CHECK(heard.header.frame_id.size == 20u && other.frame[19] == 'f' && other.frame[20] == '\0');
}

static void test_wide(void)
{
  uint_least16_t units[] = {0x48, 0xe4, 0x20ac, 0};
  uint_least16_t room[4] = {1, 1, 1, 1};
  example_interfaces__msg__WString message = {.data = {units, 3, 4}};
  example_interfaces__msg__WString heard = {.data = {room, 0, 4}};

  CHECK(rcl_publish(&wide, &message, NULL) == RCL_RET_OK);
  CHECK(rcl_take(&wide_heard, &heard, NULL, NULL) == RCL_RET_OK);
  CHECK(heard.data.size == 3u && memcmp(room, units, sizeof(room)) == 0);
  CHECK(rcl_publish(&wide, &message, NULL) == RCL_RET_OK);
  heard.data.capacity = 3;
  CHECK(rcl_take(&wide_heard, &heard, NULL, NULL) == RCL_RET_ERROR && says("too little room"));
}

/* Bytes are decoded into the queue, and a message of it is encoded. */
static void test_serialized(void)
{
  uint8_t bytes[] = {0, 1, 0, 0, 42, 0, 0, 0};
  uint8_t large[12] = {0, 1, 0, 0, 42};
  uint8_t room[8] = {0};
  rcl_serialized_message_t message = {.buffer = bytes, .buffer_length = 8, .buffer_capacity = 8};
  rcl_serialized_message_t heard = {.buffer = room, .buffer_capacity = 8};
  rmw_message_info_t info;

  heard.allocator = allocator;
  CHECK(rcl_publish_serialized_message(&count, &message, NULL) == RCL_RET_OK);
  CHECK(takes(&count_of_other, 42, NULL));
  CHECK(rcl_take_serialized_message(&count_heard, &heard, &info, NULL) == RCL_RET_OK);
  CHECK(info.from_intra_process && heard.buffer_length == 8u && memcmp(room, bytes, 8) == 0);
  CHECK(is_empty(&count_heard));
  message.buffer = large;
  message.buffer_length = sizeof(large); /* more than any message of the type */
  CHECK(rcl_publish_serialized_message(&count, &message, NULL) == RCL_RET_ERROR);
  rcl_reset_error();
  message.buffer = bytes;
  message.buffer_length = 6; /* the number ends early */
  CHECK(rcl_publish_serialized_message(&count, &message, NULL) == RCL_RET_ERROR);
  rcl_reset_error();
  CHECK(is_empty(&count_heard) && is_empty(&count_of_other));
}

static int32_t called;

static void on_count(const void * message)
{
  const std_msgs__msg__Int32 * number = message;

  called = number->data;
  if (called < 12) {
    publish(&count, called + 1); /* within a callback: the next round has it */
  }
}

/* Wait sets and executors see what waits, without a wait. */
static void test_readiness(void)
{
  static std_msgs__msg__Int32 message;
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  rclc_executor_t executor = rclc_executor_get_zero_initialized_executor();

  CHECK(rcl_wait_set_init(&wait_set, 1, 0, 0, 0, 0, 0, &support.context, allocator) == RCL_RET_OK);
  CHECK(rcl_wait_set_add_subscription(&wait_set, &count_heard, NULL) == RCL_RET_OK);
  CHECK(rcl_wait(&wait_set, 0) == RCL_RET_TIMEOUT && wait_set.subscriptions[0] == NULL);
  publish(&count, 10);
  CHECK(rcl_wait_set_clear(&wait_set) == RCL_RET_OK);
  CHECK(rcl_wait_set_add_subscription(&wait_set, &count_heard, NULL) == RCL_RET_OK);
  agent_waits = 0;
  CHECK(rcl_wait(&wait_set, -1) == RCL_RET_OK && wait_set.subscriptions[0] == &count_heard);
  CHECK(agent_waits == 0u && rcl_wait_set_fini(&wait_set) == RCL_RET_OK);
  CHECK(rclc_executor_init(&executor, &support.context, 1, &allocator) == RCL_RET_OK);
  CHECK(
    rclc_executor_add_subscription(&executor, &count_heard, &message, on_count, ON_NEW_DATA) == RCL_RET_OK);
  for (int32_t value = 10; value <= 12; ++value) {
    CHECK(rclc_executor_spin_some(&executor, 1000 * (uint64_t)ms) == RCL_RET_OK && called == value);
  }
  CHECK(agent_waits == 0u && rclc_executor_fini(&executor) == RCL_RET_OK);
  CHECK(takes(&count_of_other, 10, NULL) && takes(&count_of_other, 11, NULL));
  CHECK(takes(&count_of_other, 12, NULL));
}

/* What waited for a former owner is gone, and a closed subscription gets nothing. */
static void test_reopening(void)
{
  publish(&count, 1);
  CHECK(rcl_subscription_fini(&count_heard, &node) == RCL_RET_OK);
  publish(&count, 2);
  subscribe_to_count();
  CHECK(is_empty(&count_heard) && dropped(&count_heard) == 0u);
  publish(&count, 3);
  CHECK(takes(&count_heard, 3, NULL) && is_empty(&count_heard));
  CHECK(
    takes(&count_of_other, 1, NULL) && takes(&count_of_other, 2, NULL) && takes(&count_of_other, 3, NULL));
}

/* A subscription that hears ROS as well takes both in the order in which they came. */
static void test_both(void)
{
  rmw_message_info_t info;
  int32_t last = 0;

  CHECK(is_empty(&mixed_heard)); /* asks the agent for samples */
  agent_offer_number(MIXED_AT, 7);
  CHECK(is_empty(&count_heard)); /* receives it */
  agent_now_ns += ms;
  publish(&mixed, 8);
  agent_now_ns += ms;
  agent_offer_number(MIXED_AT, 9);
  CHECK(takes(&mixed_heard, 7, &info) && !info.from_intra_process);
  CHECK(takes(&mixed_heard, 8, &info) && info.from_intra_process);
  CHECK(takes(&mixed_heard, 9, &info) && !info.from_intra_process && is_empty(&mixed_heard));
  (void)agent_written(&last);
  publish(&shout, 11);
  CHECK(agent_written(&last) == 1u && last == 11);
  CHECK(takes(&shout_heard, 11, &info) && info.from_intra_process && is_empty(&shout_heard));
  publish(&count, 12);
  CHECK(agent_written(&last) == 0u && takes(&count_heard, 12, NULL) && takes(&count_of_other, 12, NULL));
}

/* An agent that goes away changes nothing between the endpoints of the image. */
static void test_agent_lost(void)
{
  const std_msgs__msg__Int32 message = {.data = 21};
  int32_t last = 0;

  agent_silent = true;
  for (uint32_t i = 0; i < 1000u && rcl_publish(&shout, &message, NULL) == RCL_RET_OK; ++i) {
    agent_now_ns += 100 * ms;
    CHECK(takes(&shout_heard, 21, NULL));
  }
  CHECK(says("no session")); /* of the way to ROS alone */
  CHECK(takes(&shout_heard, 21, NULL) && is_empty(&shout_heard));
  publish(&count, 22);
  CHECK(takes(&count_heard, 22, NULL) && takes(&count_of_other, 22, NULL));
  CHECK(rcl_subscription_fini(&count_heard, &node) == RCL_RET_OK);
  subscribe_to_count(); /* without an agent */
  agent_silent = false;
  (void)agent_written(&last);
  for (uint32_t i = 0; i < 1000u && rcl_publish(&shout, &message, NULL) != RCL_RET_OK; ++i) {
    agent_now_ns += 10 * ms;
    CHECK(is_empty(&count_heard));
  }
  rcl_reset_error();
  CHECK(agent_written(&last) == 1u && last == 21);
}

static void close(void)
{
  CHECK(rcl_subscription_fini(&count_heard, &node) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&count_of_other, &other_node) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&joints_heard, &node) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&wide_heard, &node) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&mixed_heard, &node) == RCL_RET_OK);
  CHECK(rcl_subscription_fini(&shout_heard, &node) == RCL_RET_OK);
  CHECK(rcl_publisher_fini(&count, &node) == RCL_RET_OK);
  CHECK(rcl_publisher_fini(&joints, &node) == RCL_RET_OK);
  CHECK(rcl_publisher_fini(&wide, &node) == RCL_RET_OK);
  CHECK(rcl_publisher_fini(&mixed, &node) == RCL_RET_OK);
  CHECK(rcl_publisher_fini(&shout, &node) == RCL_RET_OK);
  CHECK(rcl_node_fini(&other_node) == RCL_RET_OK);
  CHECK(rcl_node_fini(&node) == RCL_RET_OK);
  CHECK(rclc_support_fini(&support) == RCL_RET_OK);
}

int main(void)
{
  open();
  test_order();
  test_info();
  test_wrap();
  test_ownership();
  test_limits();
  test_wide();
  test_serialized();
  test_readiness();
  test_reopening();
  test_both();
  test_agent_lost();
  close();
  return 0;
}
