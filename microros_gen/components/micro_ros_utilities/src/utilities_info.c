/* SPDX-License-Identifier: Apache-2.0 */
/* Lists the members of a type as text, in two passes: the first one measures its length. */
#include "micro_ros_utilities/string_utilities.h"
#include "microros/utilities_walk.h"

/* The output; with `at` NULL only its length is counted. */
typedef struct info_t {
  char * at;
  size_t length;
} info_t;

static void info_put(info_t * info, char c)
{
  if (info->at != NULL) {
    info->at[info->length] = c;
  }
  ++info->length;
}

static void info_put_text(info_t * info, const char * text)
{
  for (const char * at = text; *at != '\0'; ++at) {
    info_put(info, *at);
  }
}

static void info_put_number(info_t * info, uint32_t number)
{
  uint32_t divisor = 1;

  while (number / divisor > 9u) {
    divisor *= 10u;
  }
  while (divisor != 0u) {
    info_put(info, "0123456789"[(number / divisor) % 10u]);
    divisor /= 10u;
  }
}

/* "std_msgs::msg::dds_::Int32_" becomes "std_msgs__msg/Int32". */
static void info_put_type(info_t * info, const microros_type_members_t * type)
{
  uint32_t part = 0;

  for (const char * at = type->dds_type_name; *at != '\0'; ++at) {
    if (*at == ':') {
      ++at;
      if (part != 2u) {
        info_put_text(info, part == 0u ? "__" : "/");
      }
      ++part;
    } else if (part != 2u && (*at != '_' || at[1] != '\0')) {
      info_put(info, *at);
    } else {
      /* without dds_ and the last character */
    }
  }
}

static void info_put_tabs(info_t * info, uint32_t count)
{
  for (uint32_t i = 0; i < count; ++i) {
    info_put(info, '\t');
  }
}

static void info_put_title(info_t * info, const microros_type_members_t * type)
{
  info_put_text(info, "\tIntrospection for ");
  info_put_type(info, type);
  info_put_text(info, " - ");
  info_put_number(info, type->count);
  info_put_text(info, " members, ");
  info_put_number(info, type->size);
  info_put_text(info, " B\n");
}

static void info_put_member(info_t * info, const microros_type_member_t * member)
{
  static const char * const types[] = {
    "none",   "float", "double", "long double", "char",   "wchar", "bool",   "octet",   "uint8",    "int8",
    "uint16", "int16", "uint32", "int32",       "uint64", "int64", "string", "wstring", "ROS2 type"};

  info_put_text(info, " - ");
  info_put_text(info, member->name);
  info_put_text(info, " [");
  if (utilities_is_sequence(member)) {
    info_put_text(info, "Sequence of ");
  } else if (member->shape == (uint8_t)MICROROS_MEMBER_ARRAY) {
    info_put_text(info, "Array of ");
  } else {
    /* a single value */
  }
  info_put_text(info, types[member->type]);
  if (member->nested != NULL) {
    info_put(info, ' ');
    info_put_type(info, member->nested);
  }
  info_put(info, ']');
  if (utilities_is_sequence(member) || utilities_is_text(member)) {
    info_put_text(info, " <- This should be inited");
  }
  info_put(info, '\n');
}

static void info_put_all(info_t * info, const microros_type_members_t * type)
{
  utilities_walk_t walk;
  utilities_event_t event;

  info_put_title(info, type);
  utilities_walk_begin(&walk, type, NULL);
  do {
    event = utilities_walk_next(&walk);
    if (event == UTILITIES_MEMBER) {
      info_put_tabs(info, walk.depth);
      info_put_member(info, walk.member);
      if (walk.member->nested != NULL) {
        utilities_walk_enter(&walk, NULL, 1);
      }
    }
  } while (event != UTILITIES_END);
}

rosidl_runtime_c__String micro_ros_utilities_type_info(const rosidl_message_type_support_t * type_support)
{
  const microros_type_members_t * type = utilities_type(type_support);
  rosidl_runtime_c__String text = {NULL, 0, 0};
  info_t info = {NULL, 0};

  if (type == NULL) {
    return text;
  }
  info_put_all(&info, type);
  text = micro_ros_string_utilities_init_with_size(info.length);
  if (text.data != NULL) {
    info.at = text.data;
    info.length = 0;
    info_put_all(&info, type);
    text.size = info.length;
  }
  return text;
}
