/* SPDX-License-Identifier: Apache-2.0 */
/* What sources for rclc do with strings and sequences of messages that they send; a line for each case that fails. */
#include <rcl/error_handling.h>
#include <rcutils/allocator.h>
#include <rmw_microros/message_memory.h>
#include <rosidl_runtime_c/primitives_sequence_functions.h>
#include <rosidl_runtime_c/string_functions.h>
#include <rosidl_runtime_c/u16string_functions.h>

#include <micro_ros_utilities/string_utilities.h>
#include <micro_ros_utilities/type_utilities.h>

#include <memory_msgs/msg/defaults.h>
#include <memory_msgs/msg/part.h>
#include <memory_msgs/msg/pair.h>
#include <memory_msgs/msg/tree.h>
#include <memory_msgs/msg/wide.h>
#include <memory_msgs/srv/ask.h>
#include <microros/cdr_decode.h>
#include <microros/message_type.h>
#include <sensor_msgs/msg/joint_state.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition) \
  do { \
    if (!(condition)) { \
      printf("line %d: %s\n", __LINE__, #condition); \
      failures = 1; \
    } \
  } while (0)

typedef rosidl_runtime_c__String string_t;

enum { JOINTS = 6 };

static int failures;
static const char long_text[] = "0123456789012345678901234567890123456789012345678901234567890123456789";

static void check_refused(bool done, const char * text)
{
  CHECK(!done);
  if (strcmp(rcl_get_error_string().str, text) != 0) {
    printf("%s\n", rcl_get_error_string().str);
    failures = 1;
  }
  rcl_reset_error();
}

static bool fill_joint_state(sensor_msgs__msg__JointState * msg, const char * frame)
{
  bool done = sensor_msgs__msg__JointState__init(msg) &&
              rosidl_runtime_c__String__assign(&msg->header.frame_id, frame) &&
              rosidl_runtime_c__String__Sequence__init(&msg->name, JOINTS) &&
              rosidl_runtime_c__double__Sequence__init(&msg->position, JOINTS) &&
              rosidl_runtime_c__double__Sequence__init(&msg->velocity, JOINTS) &&
              rosidl_runtime_c__double__Sequence__init(&msg->effort, JOINTS);

  for (size_t i = 0; done && i < JOINTS; ++i) {
    char name[] = "joint_0";

    name[6] = (char)('0' + (char)i);
    done = rosidl_runtime_c__String__assign(&msg->name.data[i], name);
    msg->position.data[i] = (double)i;
    msg->velocity.data[i] = 1.0;
    msg->effort.data[i] = 2.0;
  }
  return done;
}

static void joint_states(void)
{
  static sensor_msgs__msg__JointState first, second, third;

  for (int round = 0; round < 3; ++round) {
    const uint32_t refused = rmw_uros_get_refused_memory();

    CHECK(fill_joint_state(&first, "base"));
    CHECK(sensor_msgs__msg__JointState__init(&second));
    CHECK(sensor_msgs__msg__JointState__copy(&first, &second));
    CHECK(sensor_msgs__msg__JointState__are_equal(&first, &second));
    CHECK(strcmp(second.name.data[5].data, "joint_5") == 0);
    CHECK(rmw_uros_get_refused_memory() == refused);
    CHECK(sensor_msgs__msg__JointState__init(&third));
    check_refused(
      rosidl_runtime_c__double__Sequence__init(&third.position, JOINTS),
      "all blocks of 48 bytes are in use: free one, or set memory: {messages: 3} in microros.yaml");
    CHECK(third.position.data == NULL);
    check_refused(
      rosidl_runtime_c__double__Sequence__init(&third.position, 7),
      "56 bytes of a string or sequence: no sent message has more than 48: "
      "raise limits: {TYPE: {MEMBER: N}} in microros.yaml");
    CHECK(rmw_uros_get_refused_memory() == refused + 2u);
    CHECK(!rosidl_runtime_c__double__Sequence__init(&third.position, SIZE_MAX / 2));
    sensor_msgs__msg__JointState__fini(&second);
    CHECK(fill_joint_state(&third, "arm"));
    sensor_msgs__msg__JointState__fini(&first);
    sensor_msgs__msg__JointState__fini(&third);
    sensor_msgs__msg__JointState__fini(&third);
  }
}

/* Short texts first, into whichever string, and longer ones behind: the order must not matter. */
static void strings_of_two_lengths(void)
{
  static memory_msgs__msg__Pair pair;

  CHECK(rosidl_runtime_c__String__init(&pair.brief) && rosidl_runtime_c__String__init(&pair.text));
  CHECK(rosidl_runtime_c__String__assign(&pair.text, "ab"));
  CHECK(rosidl_runtime_c__String__assign(&pair.brief, "abcd"));
  CHECK(rosidl_runtime_c__String__assignn(&pair.text, long_text, 64));
  CHECK(rosidl_runtime_c__String__assign(&pair.brief, "12345678"));
  CHECK(pair.text.size == 64u && memcmp(pair.text.data, long_text, 64) == 0 && pair.text.data[64] == '\0');
  check_refused(
    rosidl_runtime_c__String__assign(&pair.text, long_text),
    "71 bytes of a string or sequence: no sent message has more than 65: "
    "raise limits: {TYPE: {MEMBER: N}} in microros.yaml");
  CHECK(pair.text.size == 64u);
  CHECK(rosidl_runtime_c__String__assign(&pair.text, "short again") && pair.text.size == 11u);
  memory_msgs__msg__Pair__fini(&pair);
  CHECK(pair.text.data == NULL && pair.text.capacity == 0u);
}

/* Every member of two messages, filled to random lengths within its limit in random order: never refused. */
static void any_order(void)
{
  static memory_msgs__msg__Pair pairs[2];
  string_t * strings[] = {&pairs[0].brief, &pairs[0].text, &pairs[1].brief, &pairs[1].text};
  const size_t limits[] = {8, 64, 8, 64};
  uint32_t refused = rmw_uros_get_refused_memory();

  srand(7);
  for (int step = 0; step < 20000; ++step) {
    const size_t i = (size_t)rand() % 4u, length = (size_t)rand() % (limits[i] + 1u);

    if (rand() % 4 == 0) {
      rosidl_runtime_c__String__fini(strings[i]);
      CHECK(rosidl_runtime_c__String__init(strings[i]));
    } else {
      CHECK(rosidl_runtime_c__String__assignn(strings[i], &long_text[length % 5u], length));
      CHECK(memcmp(strings[i]->data, &long_text[length % 5u], length) == 0);
    }
  }
  CHECK(rmw_uros_get_refused_memory() == refused);
  for (size_t i = 0; i < 4u; ++i) {
    rosidl_runtime_c__String__fini(strings[i]);
  }
}

/* Messages within messages, and what has default values. */
static void nested(void)
{
  static memory_msgs__msg__Tree tree, copy;
  static memory_msgs__msg__Defaults defaults;
  memory_msgs__msg__Defaults * made;

  CHECK(memory_msgs__msg__Tree__init(&tree) && memory_msgs__msg__Tree__init(&copy));
  CHECK(memory_msgs__msg__Part__Sequence__init(&tree.parts, 2));
  for (size_t i = 0; i < 2u; ++i) {
    CHECK(rosidl_runtime_c__String__assign(&tree.parts.data[i].label, "part"));
    CHECK(rosidl_runtime_c__float__Sequence__init(&tree.parts.data[i].values, 3));
    CHECK(rosidl_runtime_c__String__assign(&tree.pair[i], "pair"));
  }
  CHECK(memory_msgs__msg__Tree__copy(&tree, &copy));
  CHECK(memory_msgs__msg__Part__Sequence__init(&copy.parts, 1) == false); /* both blocks are taken */
  rcl_reset_error();
  memory_msgs__msg__Tree__fini(&copy);
  CHECK(memory_msgs__msg__Tree__init(&copy) && memory_msgs__msg__Part__Sequence__init(&copy.parts, 1));
  CHECK(memory_msgs__msg__Tree__copy(&tree, &copy)); /* grows within its block */
  CHECK(memory_msgs__msg__Tree__are_equal(&tree, &copy));
  memory_msgs__msg__Tree__fini(&tree);
  memory_msgs__msg__Tree__fini(&copy);
  CHECK(memory_msgs__msg__Defaults__init(&defaults));
  CHECK(strcmp(defaults.name.data, "gripper") == 0 && defaults.values.size == 2u);
  made = memory_msgs__msg__Defaults__create();
  CHECK(made != NULL && memory_msgs__msg__Defaults__are_equal(made, &defaults));
  CHECK(memory_msgs__msg__Defaults__create() != NULL || strlen(rcl_get_error_string().str) != 0u);
  rcl_reset_error();
  memory_msgs__msg__Defaults__fini(&defaults);
  memory_msgs__msg__Defaults__destroy(made);
  made = memory_msgs__msg__Defaults__create();
  CHECK(made != NULL);
  memory_msgs__msg__Defaults__destroy(made);
}

static void wide(void)
{
  static const uint16_t text[] = {'w', 0x20AC, 'x', 0};
  static memory_msgs__msg__Wide msg;

  CHECK(memory_msgs__msg__Wide__init(&msg));
  CHECK(rosidl_runtime_c__U16String__assign(&msg.text, text) && msg.text.size == 3u);
  CHECK(rosidl_runtime_c__U16String__Sequence__init(&msg.texts, 2));
  CHECK(rosidl_runtime_c__U16String__assign(&msg.texts.data[1], text));
  CHECK(!rosidl_runtime_c__U16String__resize(&msg.text, 11));
  CHECK(rosidl_runtime_c__U16String__resize(&msg.text, 10));
  memory_msgs__msg__Wide__fini(&msg);
}

static void requests_and_responses(void)
{
  static memory_msgs__srv__Ask_Request request;
  static memory_msgs__srv__Ask_Response response;

  CHECK(memory_msgs__srv__Ask_Request__init(&request) && memory_msgs__srv__Ask_Response__init(&response));
  CHECK(rosidl_runtime_c__int32__Sequence__init(&request.numbers, 4));
  CHECK(rosidl_runtime_c__uint8__Sequence__init(&response.data, 5));
  memory_msgs__srv__Ask_Request__fini(&request);
  memory_msgs__srv__Ask_Response__fini(&response);
}

/* A buffer of the application's is filled in place, and is none of the pool's. */
static void own_buffers(void)
{
  static memory_msgs__msg__Pair pair;
  char buffer[12] = "";

  pair.text.data = buffer;
  pair.text.capacity = sizeof(buffer);
  CHECK(rosidl_runtime_c__String__assign(&pair.text, "in place"));
  CHECK(pair.text.data == buffer && strcmp(buffer, "in place") == 0);
  pair.text = micro_ros_string_utilities_set(pair.text, "still here");
  CHECK(pair.text.data == buffer && strcmp(buffer, "still here") == 0);
  CHECK(rosidl_runtime_c__String__assign(&pair.text, "more than the buffer has"));
  CHECK(pair.text.data != buffer && strcmp(buffer, "still here") == 0);
  memory_msgs__msg__Pair__fini(&pair);
  pair.text.data = buffer;
  pair.text.capacity = sizeof(buffer);
  memory_msgs__msg__Pair__fini(&pair);
}

static void utilities(void)
{
  const rosidl_message_type_support_t * joint_state =
    ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState);
  static sensor_msgs__msg__JointState msgs[3];
  static memory_msgs__msg__Pair pair;
  micro_ros_utilities_memory_conf_t conf = micro_ros_utilities_memory_conf_default;
  const uint32_t refused = rmw_uros_get_refused_memory();

  conf.max_string_capacity = 16;
  conf.max_basic_type_sequence_capacity = JOINTS;
  for (int round = 0; round < 3; ++round) {
    CHECK(micro_ros_utilities_create_message_memory(joint_state, &msgs[0], conf));
    CHECK(micro_ros_utilities_create_message_memory(joint_state, &msgs[1], conf));
    CHECK(rmw_uros_get_refused_memory() == refused + (uint32_t)round);
    CHECK(!micro_ros_utilities_create_message_memory(joint_state, &msgs[2], conf));
    CHECK(msgs[0].position.capacity == 6u && msgs[0].name.data[5].capacity >= 16u);
    msgs[0].name.data[5] = micro_ros_string_utilities_set(msgs[0].name.data[5], "in its place");
    CHECK(micro_ros_utilities_destroy_message_memory(joint_state, &msgs[0], conf));
    CHECK(micro_ros_utilities_destroy_message_memory(joint_state, &msgs[1], conf));
  }
  rcl_reset_error();
  CHECK(memory_msgs__msg__Pair__init(&pair));
  pair.text = micro_ros_string_utilities_set(pair.text, "set");
  pair.text = micro_ros_string_utilities_append(pair.text, " and appended");
  CHECK(strcmp(pair.text.data, "set and appended") == 0);
  pair.brief = micro_ros_string_utilities_init("brief");
  CHECK(pair.brief.size == 5u);
  pair.brief = micro_ros_string_utilities_set(pair.brief, "");
  micro_ros_string_utilities_destroy(&pair.text);
  memory_msgs__msg__Pair__fini(&pair);
}

/* A bounded string takes as many characters as its bound, wide ones and those of a sequence too. */
static void bounds(void)
{
  const rosidl_message_type_support_t * support = ROSIDL_GET_MSG_TYPE_SUPPORT(memory_msgs, msg, Part);
  const microros_message_type_t * const type = support->data;
  micro_ros_utilities_memory_conf_t conf = micro_ros_utilities_memory_conf_default;
  static uint8_t buffer[2][400], body[400];
  static memory_msgs__msg__Part sent, received;
  static const uint16_t wide_text[] = {'1', '2', '3', '4', 0};
  cdr_fault_t fault = {.field = ""};
  uint32_t size;

  CHECK(micro_ros_utilities_create_static_message_memory(support, &sent, conf, buffer[0], sizeof(buffer[0])));
  CHECK(
    micro_ros_utilities_create_static_message_memory(support, &received, conf, buffer[1], sizeof(buffer[1])));
  CHECK(rosidl_runtime_c__String__assignn(&sent.bounded, long_text, 22));
  CHECK(rosidl_runtime_c__U16String__assign(&sent.wide_bounded, wide_text));
  sent.codes.size = 2;
  CHECK(rosidl_runtime_c__String__assign(&sent.codes.data[1], "abcde"));
  CHECK(sent.bounded.data >= (char *)buffer[0] && sent.bounded.data < (char *)buffer[0] + sizeof(buffer[0]));
  size = type->encode(&sent, body, &fault);
  CHECK(size != 0u);
  CHECK(cdr_decode(type, body, size, false, &received, &fault));
  CHECK(memory_msgs__msg__Part__are_equal(&sent, &received));
}

static size_t given; /* blocks of the application's allocator */

static void * own_allocate(size_t size, void * state)
{
  (void)state;
  ++given;
  return malloc(size);
}

static void * own_zero_allocate(size_t count, size_t size, void * state)
{
  (void)state;
  ++given;
  return calloc(count, size);
}

static void * own_reallocate(void * pointer, size_t size, void * state)
{
  (void)state;
  return realloc(pointer, size);
}

static void own_deallocate(void * pointer, void * state)
{
  (void)state;
  given -= pointer != NULL ? 1u : 0u;
  free(pointer);
}

/* An allocator of the application overrides the pools; what is of a pool goes back there. */
static void own_allocator(void)
{
  rcutils_allocator_t own = {own_allocate, own_deallocate, own_reallocate, own_zero_allocate, NULL};
  static sensor_msgs__msg__JointState before, msgs[4];

  CHECK(fill_joint_state(&before, "before"));
  CHECK(rcutils_set_default_allocator(&own));
  sensor_msgs__msg__JointState__fini(&before);
  CHECK(given == 0u);
  for (size_t i = 0; i < 4u; ++i) {
    CHECK(fill_joint_state(&msgs[i], long_text));
  }
  CHECK(given == 44u);
  for (size_t i = 0; i < 4u; ++i) {
    sensor_msgs__msg__JointState__fini(&msgs[i]);
  }
  CHECK(given == 0u);
}

int main(void)
{
  joint_states();
  strings_of_two_lengths();
  any_order();
  nested();
  wide();
  requests_and_responses();
  own_buffers();
  utilities();
  bounds();
  own_allocator();
  return failures;
}
