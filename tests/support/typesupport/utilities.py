# SPDX-License-Identifier: Apache-2.0
"""The program of test_utilities.py, its types, and the capacities that the public library gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping

PACKAGE = {
    "Item.msg": "string label\nfloat64[] values\n",
    "Mixed.msg": "uint8 tiny\nstring[3] words\nItem[2] pair\nItem[] items\nItem[<=3] few\nstring<=10 short_name\n"
    "string<=7[<=2] codes\nfloat64[<=4] bounded\nbool[] flags\nint32[2] fixed\nwstring wide\nwstring[] wides\n",
    "Deep.msg": "Mixed[] mixed\nMixed single\n",
}

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: {components}
interfaces:
  - sensor_msgs/msg/JointState
  - sensor_msgs/msg/Image
  - std_msgs/msg/String
  - std_msgs/msg/Int32
  - std_msgs/msg/Empty
  - std_msgs/msg/MultiArrayLayout
  - trajectory_msgs/msg/JointTrajectory
  - utilities_msgs/msg/Mixed
  - utilities_msgs/msg/Deep
limits:
  "*": {{string: 4, sequence: 1}}
  std_msgs/msg/String: {{data: 25}}
transport: {{mtu: 8000}}
memory: {{arena: 8192}}
"""

SMALL = """\
version: 1
profiles: [pure_sender]
components: {components}
interfaces: [std_msgs/msg/String]
limits: {{"*": {{string: 4}}}}
"""

Sizes = Callable[[int], int]
"""The bytes that an allocator is asked for, by the size of a pointer."""


def _joint_state(p: int) -> int:
    return 30 + 6 * 3 * p + 6 * 16 + 3 * 6 * 8


def _mixed(p: int, items: int, label: int, values: int, flags: int, words: int, wides: int) -> int:
    """Bytes of one Mixed: two numbers of a pair, then sequences, bounded sequences, strings."""
    string, item = 3 * p, 6 * p
    inner = label + 8 * values
    found = 3 * words + 2 * inner + items * (item + inner) + 3 * (item + inner)
    found += 11 + 2 * (string + 8) + 4 * 8 + flags
    return found + 2 * 20 + wides * (string + 2 * 20)


MIXED_DEFAULT = {
    "words[0]": 20,
    "words[2]": 20,  # the public library gives memory to the first string of an array alone
    "pair[0].label": 20,
    "pair[0].values": 5,
    "pair[1].label": 20,  # likewise
    "items": 5,
    "items[4].label": 20,
    "items[4].values": 5,
    "few": 3,
    "few[2].values": 5,
    "short_name": 11,  # the public library gives no room for the terminator of a bounded string
    "codes": 2,
    "codes[1]": 8,
    "bounded": 4,
    "flags": 5,
    "wide": 20,  # the public library gives none to a wstring, and bytes to a sequence of them
    "wides": 5,
    "wides[4]": 20,
}

MIXED_RULES = MIXED_DEFAULT | {
    "words[0]": 9,
    "words[2]": 9,
    "pair[0].values": 7,
    "pair[1].values": 7,
    "items": 2,
    "items[1].label": 33,
    "few": 1,
    "codes": 3,
    "codes[1]": 5,
    "bounded": 6,
    "flags": 0,
}
del MIXED_RULES["items[4].label"], MIXED_RULES["items[4].values"], MIXED_RULES["few[2].values"]

CASES: Mapping[str, tuple[Mapping[str, int], Sizes]] = {
    "layout": (
        {"dim": 5, "dim[4].label": 20},
        # The public library's own test has 260 for 64 bits.
        lambda p: 5 * (3 * p + 8) + 5 * 20,
    ),
    "layout rules": ({"dim": 3, "dim[2].label": 100}, lambda p: 3 * (3 * p + 8) + 3 * 100),
    "trajectory": (
        {
            "header.frame_id": 20,
            "joint_names": 5,
            "joint_names[4]": 20,
            "points": 5,
            "points[4].positions": 5,
            "points[4].effort": 5,
        },
        lambda p: 20 + 5 * (3 * p + 20) + 5 * (4 * 3 * p + 8 + 4 * 5 * 8),
    ),
    "trajectory rules": (
        {
            "header.frame_id": 20,
            "joint_names": 16,
            "joint_names[15]": 5,
            "points": 2,
            "points[1].positions": 16,
            "points[1].effort": 4,
        },
        lambda p: 20 + 16 * (3 * p + 5) + 2 * (4 * 3 * p + 8 + 16 * 8 + 3 * 4 * 8),
    ),
    "joint state": (
        {"header.frame_id": 30, "name": 6, "name[5]": 16, "position": 6, "velocity": 6, "effort": 6},
        _joint_state,
    ),
    "image": ({"header.frame_id": 50, "encoding": 50, "data": 1024}, lambda p: 50 + 50 + 1024),
    "string": ({"data": 20}, lambda p: 20),
    "number": ({}, lambda p: 0),
    "nothing": ({}, lambda p: 0),
    "mixed": (MIXED_DEFAULT, lambda p: _mixed(p, 5, 20, 5, 5, 20, 5)),
    "mixed rules": (
        MIXED_RULES,
        lambda p: (
            3 * 9
            + 2 * (20 + 7 * 8)
            + 2 * (6 * p + 33 + 5 * 8)
            + (6 * p + 20 + 5 * 8)
            + 11
            + 3 * (3 * p + 5)
            + 6 * 8
            + 2 * 20
            + 5 * (3 * p + 2 * 20)
        ),
    ),
    "deep": (
        {f"mixed[1].{key}": value for key, value in MIXED_DEFAULT.items() if "items" not in key}
        | {
            "mixed": 2,
            "mixed[1].items": 2,
            "mixed[1].items[1].values": 3,
            "single.items": 2,
            "single.flags": 5,
        },
        lambda p: 2 * _sizeof_mixed(p) + 2 * _deep(p, 3) + _deep(p, 5),
    ),
}


def _deep(p: int, values: int) -> int:
    """One Mixed with two items, whose `values` have a rule for those in the sequence."""
    return _mixed(p, 2, 20, 5, 5, 20, 5) + 2 * 8 * (values - 5)


def _sizeof_mixed(p: int) -> int:
    """tiny with padding, words, pair, eight heads of strings and sequences, fixed."""
    heads = 3 + 4 + 8
    return p + heads * 3 * p + 8


HEAD = r"""
#include <micro_ros_utilities/string_utilities.h>
#include <micro_ros_utilities/type_utilities.h>
#include <microros/message_type.h>
#include <rcl/error_handling.h>
#include <sensor_msgs/msg/image.h>
#include <sensor_msgs/msg/joint_state.h>
#include <std_msgs/msg/empty.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/multi_array_layout.h>
#include <std_msgs/msg/string.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <trajectory_msgs/msg/joint_trajectory.h>
#include <utilities_msgs/msg/deep.h>
#include <utilities_msgs/msg/mixed.h>

/* An allocator that counts. */
static size_t asked, held, calls, fail_at = SIZE_MAX;

static void * count_allocate(size_t size, void * state)
{
  (void)state;
  if (calls++ == fail_at) {
    return NULL;
  }
  asked += size;
  ++held;
  return malloc(size);
}

static void count_deallocate(void * pointer, void * state)
{
  (void)state;
  held -= pointer != NULL;
  free(pointer);
}

static void * count_reallocate(void * pointer, size_t size, void * state)
{
  (void)pointer;
  (void)size;
  (void)state;
  return NULL;
}

static void * count_zero_allocate(size_t number, size_t size, void * state)
{
  (void)number;
  (void)size;
  (void)state;
  return NULL;
}

static rcutils_allocator_t counting = {
  count_allocate, count_deallocate, count_reallocate, count_zero_allocate, NULL};

/* The blocks of the message at hand. */
static struct {
  unsigned char * data;
  size_t bytes, capacity, element;
} blocks[1000];
static size_t blocks_used;
static int shows;

static void block(const char * name, void * data, size_t size, size_t capacity, size_t element)
{
  if (shows) {
    printf("%s: %zu\n", name, capacity);
  }
  if (size != 0 || (data == NULL) != (capacity == 0)) {
    printf("%s is not as it should be\n", name);
  }
  blocks[blocks_used].data = data;
  blocks[blocks_used].capacity = capacity;
  blocks[blocks_used].element = element;
  blocks[blocks_used++].bytes = capacity * element;
}

static int by_address(const void * a, const void * b)
{
  const uintptr_t x = (uintptr_t)*(unsigned char * const *)a, y = (uintptr_t)*(unsigned char * const *)b;
  return (x > y) - (x < y);
}

/* What no block may be: not aligned, not zero where it holds no heads of others, in another. Writes every byte. */
static int blocks_wrong(void)
{
  int wrong = 0;
  qsort(blocks, blocks_used, sizeof(blocks[0]), by_address);
  for (size_t i = 0; i < blocks_used; ++i) {
    const size_t element = blocks[i].element, power = element & (~element + 1);
    wrong |= ((uintptr_t)blocks[i].data & ((power < sizeof(void *) ? power : sizeof(void *)) - 1)) != 0;
    for (size_t k = 0; element <= 8 && k < blocks[i].bytes; ++k) {
      wrong |= blocks[i].data[k] != 0;
    }
    wrong |= i != 0 && blocks[i - 1].bytes != 0 && &blocks[i - 1].data[blocks[i - 1].bytes] > blocks[i].data;
  }
  for (size_t i = 0; i < blocks_used; ++i) {
    if (blocks[i].bytes != 0) {
      memset(blocks[i].data, 0x77, blocks[i].bytes);
    }
  }
  return wrong;
}

#define B(m) block(#m, message->m.data, message->m.size, message->m.capacity, sizeof(message->m.data[0]))
#define BN(base, m) do { char full[99]; snprintf(full, sizeof(full), "%s%s", base, #m); \
  block(full, message->m.data, message->m.size, message->m.capacity, sizeof(message->m.data[0])); } while (0)
"""

# One function a type tells of every block; elements are shown by the index of the last one, all are written.
SHOW = r"""
static void layout(const void * from)
{
  const std_msgs__msg__MultiArrayLayout * message = from;
  B(dim);
  for (size_t i = 0; i < message->dim.capacity; ++i) {
    char name[40];
    snprintf(name, sizeof(name), "dim[%zu].label", i);
    block(name, message->dim.data[i].label.data, 0, message->dim.data[i].label.capacity, 1);
  }
}

static void trajectory(const void * from)
{
  const trajectory_msgs__msg__JointTrajectory * message = from;
  char name[40];
  B(header.frame_id);
  B(joint_names);
  for (size_t i = 0; i < message->joint_names.capacity; ++i) {
    snprintf(name, sizeof(name), "joint_names[%zu]", i);
    block(name, message->joint_names.data[i].data, 0, message->joint_names.data[i].capacity, 1);
  }
  B(points);
  for (size_t i = 0; i < message->points.capacity; ++i) {
    const trajectory_msgs__msg__JointTrajectoryPoint * point = &message->points.data[i];
    snprintf(name, sizeof(name), "points[%zu].positions", i);
    block(name, point->positions.data, point->positions.size, point->positions.capacity, 8);
    block("v", point->velocities.data, point->velocities.size, point->velocities.capacity, 8);
    block("a", point->accelerations.data, point->accelerations.size, point->accelerations.capacity, 8);
    snprintf(name, sizeof(name), "points[%zu].effort", i);
    block(name, point->effort.data, point->effort.size, point->effort.capacity, 8);
  }
}

static void joint_state(const void * from)
{
  const sensor_msgs__msg__JointState * message = from;
  B(header.frame_id);
  B(name);
  for (size_t i = 0; i < message->name.capacity; ++i) {
    char name[40];
    snprintf(name, sizeof(name), "name[%zu]", i);
    block(name, message->name.data[i].data, 0, message->name.data[i].capacity, 1);
  }
  B(position);
  B(velocity);
  B(effort);
}

static void image(const void * from)
{
  const sensor_msgs__msg__Image * message = from;
  B(header.frame_id);
  B(encoding);
  B(data);
}

static void string(const void * from)
{
  const std_msgs__msg__String * message = from;
  B(data);
}

static void number(const void * from) { (void)from; }

static void items(const char * base, const utilities_msgs__msg__Item * all, size_t count)
{
  for (size_t i = 0; i < count; ++i) {
    char name[120];
    snprintf(name, sizeof(name), "%s[%zu].label", base, i);
    block(name, all[i].label.data, all[i].label.size, all[i].label.capacity, 1);
    snprintf(name, sizeof(name), "%s[%zu].values", base, i);
    block(name, all[i].values.data, all[i].values.size, all[i].values.capacity, 8);
  }
}

static void mixed_at(const char * base, const utilities_msgs__msg__Mixed * message)
{
  char name[99];
  for (size_t i = 0; i < 3; ++i) {
    snprintf(name, sizeof(name), "%swords[%zu]", base, i);
    block(name, message->words[i].data, message->words[i].size, message->words[i].capacity, 1);
  }
  snprintf(name, sizeof(name), "%spair", base);
  items(name, message->pair, 2);
  BN(base, items);
  snprintf(name, sizeof(name), "%sitems", base);
  items(name, message->items.data, message->items.capacity);
  BN(base, few);
  snprintf(name, sizeof(name), "%sfew", base);
  items(name, message->few.data, message->few.capacity);
  BN(base, short_name);
  BN(base, codes);
  for (size_t i = 0; i < message->codes.capacity; ++i) {
    snprintf(name, sizeof(name), "%scodes[%zu]", base, i);
    block(name, message->codes.data[i].data, 0, message->codes.data[i].capacity, 1);
  }
  BN(base, bounded);
  BN(base, flags);
  BN(base, wide);
  BN(base, wides);
  for (size_t i = 0; i < message->wides.capacity; ++i) {
    snprintf(name, sizeof(name), "%swides[%zu]", base, i);
    block(name, message->wides.data[i].data, 0, message->wides.data[i].capacity, 2);
  }
}

static void mixed(const void * from) { mixed_at("", from); }

static void deep(const void * from)
{
  const utilities_msgs__msg__Deep * message = from;
  B(mixed);
  for (size_t i = 0; i < message->mixed.capacity; ++i) {
    char name[40];
    snprintf(name, sizeof(name), "mixed[%zu].", i);
    mixed_at(name, &message->mixed.data[i]);
  }
  mixed_at("single.", &message->single);
}
"""

TEST = r"""
typedef void (*show_t)(const void * message);
typedef const rosidl_message_type_support_t * support_t;

static void collect(show_t show, const void * message)
{
  blocks_used = 0;
  show(message);
}

static void test(support_t support, void * message, size_t size, show_t show, micro_ros_utilities_memory_conf_t conf)
{
  size_t static_size, needed = 0, capacities, overlaps = 0, same = 1, smaller = 0;
  static unsigned char before[600];
  static size_t first[1000];

  conf.allocator = &counting;
  printf("size: %zu\n", micro_ros_utilities_get_dynamic_size(support, conf));
  memset(message, 0xA5, size);
  if (!micro_ros_utilities_create_message_memory(support, message, conf)) {
    printf("failed: %s\n", rcl_get_error_string().str);
  }
  shows = 1;
  collect(show, message);
  shows = 0;
  capacities = blocks_used;
  for (size_t i = 0; i < blocks_used; ++i) {
    first[i] = blocks[i].capacity;
  }
  if (!micro_ros_utilities_destroy_message_memory(support, message, conf)) {
    puts("destroy failed");
  }
  for (size_t i = 0; i < size; ++i) {
    overlaps |= ((unsigned char *)message)[i] != 0;
  }
  printf("asked: %zu\nleft: %zu\n", asked, held);

  conf.allocator = NULL;
  static_size = micro_ros_utilities_get_static_size(support, conf);
  for (size_t offset = 0; offset < 8; ++offset) {
    uint8_t * const buffer = malloc(static_size + offset);
    uint8_t * const start = &buffer[offset];

    memset(buffer, 0x5A, static_size + offset);
    if (static_size != 0) {
      memset(message, 0xA5, size);
      memcpy(before, message, size);
      smaller |= micro_ros_utilities_create_static_message_memory(support, message, conf, start, static_size - 1);
      smaller |= memcmp(before, message, size) != 0 || start[0] != 0x5A;
    }
    if (!micro_ros_utilities_create_static_message_memory(support, message, conf, start, static_size)) {
      printf("failed: %s\n", rcl_get_error_string().str);
    }
    collect(show, message);
    same &= blocks_used == capacities;
    for (size_t i = 0; i < blocks_used; ++i) {
      const size_t end = blocks[i].data == NULL ? 0 : (size_t)(&blocks[i].data[blocks[i].bytes] - start);
      same &= blocks[i].capacity == first[i];
      needed = end > needed ? end : needed;
    }
    overlaps |= (size_t)blocks_wrong();
    free(buffer);
  }
  printf("same: %zu\nstatic: %zu\nneeded: %zu\nsmaller: %zu\noverlaps: %zu\n",
    same, static_size, needed, smaller, overlaps);
}
"""

CALLS = r"""
typedef micro_ros_utilities_memory_rule_t rule_t;
typedef micro_ros_utilities_memory_conf_t conf_t;
#define RULES(list) (sizeof(list) / sizeof(list[0]))
#define TYPE(p, t) ROSIDL_GET_MSG_TYPE_SUPPORT(p, msg, t)

static std_msgs__msg__MultiArrayLayout a_layout;
static trajectory_msgs__msg__JointTrajectory a_trajectory;
static sensor_msgs__msg__JointState a_joint_state;
static sensor_msgs__msg__Image an_image;
static std_msgs__msg__String a_string;
static std_msgs__msg__Int32 a_number;
static std_msgs__msg__Empty nothing;
static utilities_msgs__msg__Mixed a_mixed;
static utilities_msgs__msg__Deep a_deep;

static void run_layout(int rules)
{
  static const rule_t list[] = {{"dim", 3}, {"dim.label", 100}};
  conf_t conf = micro_ros_utilities_memory_conf_default;
  if (rules) {
    conf.rules = list;
    conf.n_rules = RULES(list);
  }
  test(TYPE(std_msgs, MultiArrayLayout), &a_layout, sizeof(a_layout), layout, conf);
}

static void run_trajectory(int rules)
{
  static const rule_t list[] = {
    {"joint_names", 16}, {"joint_names.data", 5}, {"points", 2}, {"points.positions", 16}};
  static conf_t conf = {0};
  if (rules) {
    conf.rules = list;
    conf.n_rules = RULES(list);
    conf.max_basic_type_sequence_capacity = 4;
  }
  test(TYPE(trajectory_msgs, JointTrajectory), &a_trajectory, sizeof(a_trajectory), trajectory, conf);
}

static void run_joint_state(void)
{
  static conf_t conf = {0};
  rule_t list[] = {{"name.data", 16}};
  conf.max_string_capacity = 30;
  conf.max_ros2_type_sequence_capacity = 10;
  conf.max_basic_type_sequence_capacity = 6;
  conf.rules = list;
  conf.n_rules = 1;
  test(TYPE(sensor_msgs, JointState), &a_joint_state, sizeof(a_joint_state), joint_state, conf);
}

static void run_image(void)
{
  static conf_t conf = {50, 5, 5, NULL, 0, NULL};
  static const rule_t list[] = {{"data", 1024}};
  conf.rules = list;
  conf.n_rules = 1;
  test(TYPE(sensor_msgs, Image), &an_image, sizeof(an_image), image, conf);
}

static void run_mixed(int rules)
{
  static const rule_t list[] = {
    {"words", 9}, {"pair.values", 7}, {"items", 2}, {"items.label", 33}, {"few.", 1}, {"codes.data", 5},
    {"codes", 3}, {"bounded", 6}, {"flags", 0}, {"items", 99}};
  conf_t conf = {0, 0, 0, list, rules ? RULES(list) : 0, NULL};
  test(TYPE(utilities_msgs, Mixed), &a_mixed, sizeof(a_mixed), mixed, conf);
}

static void run_deep(void)
{
  static const rule_t list[] = {{"mixed", 2}, {"mixed.items", 2}, {"mixed.items.values", 3}, {"single.items", 2}};
  const conf_t conf = {0, 0, 0, list, RULES(list), NULL};
  test(TYPE(utilities_msgs, Deep), &a_deep, sizeof(a_deep), deep, conf);
}

/* Each allocation of a message fails once. */
static void run_failing(void)
{
  static const rule_t list[] = {{"mixed", 1}};
  const conf_t conf = {0, 0, 2, list, 1, &counting};
  size_t succeeded = 0, still_held = 0, dirty = 0, count;
  if (!micro_ros_utilities_create_message_memory(TYPE(utilities_msgs, Deep), &a_deep, conf)) {
    puts("failed: 1");
  }
  count = calls;
  (void)micro_ros_utilities_destroy_message_memory(TYPE(utilities_msgs, Deep), &a_deep, conf);
  for (fail_at = 0; fail_at < count; ++fail_at) {
    calls = 0;
    memset(&a_deep, 0xA5, sizeof(a_deep));
    succeeded += micro_ros_utilities_create_message_memory(TYPE(utilities_msgs, Deep), &a_deep, conf);
    still_held += held;
    for (size_t i = 0; i < sizeof(a_deep); ++i) {
      dirty += ((unsigned char *)&a_deep)[i] != 0;
    }
  }
  printf("calls: %zu\nsucceeded: %zu\nheld: %zu\ndirty: %zu\n", count, succeeded, still_held, dirty);
}

static void refuse(const char * what, const char * name, support_t support, conf_t conf)
{
  static uint8_t buffer[4000];
  const size_t dynamic = micro_ros_utilities_get_dynamic_size(support, conf);
  const size_t fixed = micro_ros_utilities_get_static_size(support, conf);
  const int created = micro_ros_utilities_create_message_memory(support, &a_joint_state, conf);
  int placed;
  rcl_reset_error();
  placed =
    micro_ros_utilities_create_static_message_memory(support, &a_joint_state, conf, buffer, sizeof(buffer));
  printf("%s%s: %zu %zu %d %d %s\n", what, name, dynamic, fixed, created, placed, rcl_get_error_string().str);
  rcl_reset_error();
}

static void say(const char * what, int result)
{
  printf("%s: %d %s\n", what, result, rcl_get_error_string().str);
  rcl_reset_error();
}

static void run_refused(void)
{
  static const char * const names[] = {
    "nam", "names", "header", "header.stamp", "header.frame_id.data", "name.datum", "name.data.x", ""};
  const support_t state = TYPE(sensor_msgs, JointState), text = TYPE(std_msgs, String);
  static const microros_message_type_t unknown = {"a::msg::dds_::B_", 1, NULL, NULL, NULL};
  const rosidl_message_type_support_t other = {state->typesupport_identifier, &unknown};
  conf_t conf = micro_ros_utilities_memory_conf_default;
  rule_t list[] = {{"position", 3}, {NULL, 9}};
  uint8_t buffer[19];
  refuse("no type", "", NULL, conf);
  refuse("other type", "", &other, conf);
  conf.rules = list;
  conf.n_rules = 2;
  refuse("no text", "", state, conf);
  for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); ++i) {
    list[1].rule = names[i];
    refuse("rule ", names[i], state, conf);
  }
  list[1].rule = "name";
  list[1].size = SIZE_MAX / 2;
  refuse("overflow", "", state, conf);
  conf.rules = NULL;
  refuse("no rules", "", state, conf);
  conf.n_rules = 0;
  say("no message", micro_ros_utilities_create_message_memory(state, NULL, conf));
  say("no buffer", micro_ros_utilities_create_static_message_memory(text, &a_string, conf, NULL, 99));
  say("small buffer", micro_ros_utilities_create_static_message_memory(text, &a_string, conf, buffer, 19));
  conf.allocator = &counting;
  fail_at = calls;
  say("allocator", micro_ros_utilities_create_message_memory(text, &a_string, conf));
  conf.allocator = NULL;
  conf.max_string_capacity = 9000;
  say("arena", micro_ros_utilities_create_message_memory(text, &a_string, conf));
}

static void text(const char * what, rosidl_runtime_c__String str)
{
  const char * data = micro_ros_string_utilities_get_c_str(str);
  printf("%s: %s %zu %zu\n", what, data == NULL ? "NULL" : data, str.size, str.capacity);
}

static void run_strings(void)
{
  char own[5] = "0123";
  rosidl_runtime_c__String str, set, lent = {own, 4, sizeof(own)};
  (void)rcutils_set_default_allocator(&counting);
  str = micro_ros_string_utilities_init("");
  text("empty", str);
  micro_ros_string_utilities_destroy(&str);
  str = micro_ros_string_utilities_init_with_size(10);
  text("with size", str);
  str = micro_ros_string_utilities_append(str, "ab");
  text("append in place", str);
  micro_ros_string_utilities_destroy(&str);
  str = micro_ros_string_utilities_init("hello");
  text("init", str);
  str = micro_ros_string_utilities_set(str, "hi");
  text("set shorter", str);
  fail_at = calls;
  set = micro_ros_string_utilities_set(str, "too long for it");
  text("no memory", set);
  fail_at = calls;
  text("no memory at all", micro_ros_string_utilities_init("x"));
  str = micro_ros_string_utilities_set(str, "good morning");
  text("set longer", str);
  str = micro_ros_string_utilities_set(str, "abcdefghijklm");
  text("set as long as the capacity", str);
  str = micro_ros_string_utilities_append(str, ", n");
  text("append", str);
  str = micro_ros_string_utilities_remove_tail_chars(str, 5);
  text("cut", str);
  str = micro_ros_string_utilities_remove_tail_chars(str, 99);
  text("cut all", str);
  micro_ros_string_utilities_destroy(&str);
  micro_ros_string_utilities_destroy(NULL);
  text("destroyed", str);
  lent = micro_ros_string_utilities_set(lent, "0123");
  printf("static: %s %zu %zu stays %d\n", lent.data, lent.size, lent.capacity, lent.data == own);
  printf("left: %zu\n", held);
}

static void run_grown(void)
{
  /* The arena takes over what it does not own, and leaves it where it is. */
  char own[5] = "0123";
  rosidl_runtime_c__String str = {own, 4, sizeof(own)};
  str = micro_ros_string_utilities_append(str, "456");
  printf("static grown: %s %zu %zu left %d\n", str.data, str.size, str.capacity, str.data != own);
  micro_ros_string_utilities_destroy(&str);
}

static void run_info(void)
{
  rosidl_runtime_c__String info = micro_ros_utilities_type_info(TYPE(std_msgs, MultiArrayLayout));
  fputs(info.data, stdout);
  micro_ros_string_utilities_destroy(&info);
}

static void run_limit(void)
{
  const support_t support = TYPE(std_msgs, String);
  const microros_message_type_t * const type = support->data;
  cdr_fault_t fault = {.field = ""};
  conf_t conf = micro_ros_utilities_memory_conf_default;
  conf.max_string_capacity = 100;
  if (!micro_ros_utilities_create_message_memory(support, &a_string, conf)) {
    puts("failed: 1");
  }
  a_string.data = micro_ros_string_utilities_set(a_string.data, "a text that has 25 bytes.");
  printf("fits: %u\n", (unsigned)type->encoded_size(&a_string, &fault));
  a_string.data = micro_ros_string_utilities_append(a_string.data, "!");
  printf("above: %u ", (unsigned)type->encoded_size(&a_string, &fault));
  printf("%s %u %u\n", fault.field, (unsigned)fault.found, (unsigned)fault.fits);
  (void)micro_ros_utilities_destroy_message_memory(support, &a_string, conf);
}

int main(int argc, char * argv[])
{
  const char * const name = argc > 1 ? argv[1] : "";
  const int rules = strstr(name, "rules") != NULL;
  const conf_t usual = micro_ros_utilities_memory_conf_default;
  if (strncmp(name, "layout", 6) == 0) {
    run_layout(rules);
  } else if (strncmp(name, "trajectory", 10) == 0) {
    run_trajectory(rules);
  } else if (strncmp(name, "mixed", 5) == 0) {
    run_mixed(rules);
  } else if (strcmp(name, "joint state") == 0) {
    run_joint_state();
  } else if (strcmp(name, "image") == 0) {
    run_image();
  } else if (strcmp(name, "deep") == 0) {
    run_deep();
  } else if (strcmp(name, "string") == 0) {
    test(TYPE(std_msgs, String), &a_string, sizeof(a_string), string, usual);
  } else if (strcmp(name, "number") == 0) {
    test(TYPE(std_msgs, Int32), &a_number, sizeof(a_number), number, usual);
  } else if (strcmp(name, "nothing") == 0) {
    test(TYPE(std_msgs, Empty), &nothing, sizeof(nothing), number, usual);
  } else if (strcmp(name, "failing") == 0) {
    run_failing();
  } else if (strcmp(name, "refused") == 0) {
    run_refused();
  } else if (strcmp(name, "strings") == 0) {
    run_grown();
    run_strings();
  } else if (strcmp(name, "info") == 0) {
    run_info();
  } else {
    run_limit();
  }
  return 0;
}
"""

PROGRAM = HEAD + SHOW + TEST + CALLS
