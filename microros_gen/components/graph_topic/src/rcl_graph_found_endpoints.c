/* SPDX-License-Identifier: Apache-2.0 */
/* Endpoints of a topic: the message has their nodes and types, neither QoS nor identifiers. */
#include "microros/error.h"
#include "microros/rcl_graph.h"
#include "microros/rcl_graph_scan.h"
#include "microros/text.h"

#include <string.h>

typedef struct endpoints_list_t {
  const char * name;
  const char * type; /* of those that are counted; "": any */
  rcutils_allocator_t * allocator;
  rcl_topic_endpoint_info_array_t * into; /* NULL: they are counted only */
  size_t count;
  rcl_graph_kind_t kind;
} endpoints_list_t;

static void endpoints_drop(void * list)
{
  endpoints_list_t * wanted = list;

  wanted->count = 0;
  if (wanted->into != NULL) {
    /* Cannot fail: the arguments were checked. */
    (void)rmw_topic_endpoint_info_array_fini(wanted->into, wanted->allocator);
  }
}

/* Sets what the message does not tell. */
static void endpoints_prepare(rmw_topic_endpoint_info_t * info, rcl_graph_kind_t kind)
{
  *info = rmw_get_zero_initialized_topic_endpoint_info();
  info->endpoint_type = kind == RCL_GRAPH_PUBLISHERS ? RMW_ENDPOINT_PUBLISHER : RMW_ENDPOINT_SUBSCRIPTION;
  info->qos_profile.history = RMW_QOS_POLICY_HISTORY_UNKNOWN;
  info->qos_profile.reliability = RMW_QOS_POLICY_RELIABILITY_UNKNOWN;
  info->qos_profile.durability = RMW_QOS_POLICY_DURABILITY_UNKNOWN;
  info->qos_profile.liveliness = RMW_QOS_POLICY_LIVELINESS_UNKNOWN;
}

static rcl_ret_t endpoints_add(const endpoints_list_t * wanted, const rcl_graph_cdr_t * cdr)
{
  rcl_topic_endpoint_info_array_t * into = wanted->into;
  void * infos = into->info_array;
  rmw_topic_endpoint_info_t * info;
  char * node = NULL;
  char * namespace_ = NULL;
  rcl_ret_t result;

  if (cdr->node.truncated || cdr->type.truncated) {
    return RCL_RET_ERROR;
  }
  if (!rcl_graph_grow(&infos, into->size, sizeof(*info), wanted->allocator)) {
    return RCL_RET_BAD_ALLOC;
  }
  into->info_array = infos;
  info = &into->info_array[into->size];
  endpoints_prepare(info, wanted->kind);
  ++into->size; /* so that it is freed with the array */
  result = rcl_graph_split(cdr->node.data, cdr->node.size, wanted->allocator, &node, &namespace_);
  info->node_name = node;
  info->node_namespace = namespace_;
  if (result != RCL_RET_OK) {
    return result;
  }
  info->topic_type = rcl_graph_copy(cdr->type.data, cdr->type.size, wanted->allocator);
  return info->topic_type != NULL ? RCL_RET_OK : RCL_RET_BAD_ALLOC;
}

static rcl_ret_t endpoints_scan(void * list, const rcl_graph_cdr_t * cdr, rcl_graph_part_t part)
{
  endpoints_list_t * wanted = list;
  const bool any_type = wanted->type[0] == '\0';

  if (
    part == RCL_GRAPH_PART_NODE || cdr->kind != (uint8_t)wanted->kind ||
    !rcl_graph_text_equals(&cdr->entity, wanted->name)) {
    return RCL_RET_OK;
  }
  if (wanted->into != NULL) {
    return part == RCL_GRAPH_PART_TYPE ? endpoints_add(wanted, cdr) : RCL_RET_OK;
  }
  if (
    part == RCL_GRAPH_PART_ENTITY ? any_type : !any_type && rcl_graph_text_equals(&cdr->type, wanted->type)) {
    ++wanted->count;
  }
  return RCL_RET_OK;
}

static bool endpoints_is_letter(char character)
{
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') || character == '_';
}

/* Whether a name is a fully qualified one of ROS: tokens after slashes, none of which begins with a digit. */
static bool endpoints_is_valid(const char * name)
{
  bool is_valid = name[0] == '/';
  bool is_begin = false; /* of a token */

  for (size_t i = 0; name[i] != '\0' && is_valid; ++i) {
    if (name[i] == '/') {
      is_valid = !is_begin;
      is_begin = true;
    } else {
      is_valid = endpoints_is_letter(name[i]) || (name[i] >= '0' && name[i] <= '9' && !is_begin);
      is_begin = false;
    }
  }
  return is_valid && !is_begin;
}

/* Returns RCL_RET_OK for a name that can be one of ROS, as rcl and a graph server do; otherwise a text is set. */
static rcl_ret_t endpoints_check(const char * name)
{
  if (endpoints_is_valid(name)) {
    return RCL_RET_OK;
  }
  microros_error_set(
    microros_error_name, name,
    name[0] == '/' ? MICROROS_ERROR_WORDS("the topic name is invalid")
                   : MICROROS_ERROR_WORDS("a fully qualified name begins with a slash"),
    0, 0);
  return RCL_RET_INVALID_ARGUMENT;
}

static const char in_dds[] = "dds_::";

/* Returns whether a text begins with in_dds. */
static bool endpoints_begins(const MICROROS_ANYWHERE char * text)
{
  size_t i = 0;

  while (i < sizeof(in_dds) - 1u && text[i] == in_dds[i]) {
    ++i;
  }
  return i == sizeof(in_dds) - 1u;
}

/* Writes the name in ROS of a type: `std_msgs/msg/Int32` for `std_msgs::msg::dds_::Int32_`. */
static void endpoints_write_type(const MICROROS_ANYWHERE char * dds_type, char type[MICROROS_GRAPH_NAME_SIZE])
{
  const MICROROS_ANYWHERE char * from = dds_type;
  size_t size = 0;

  while (*from != '\0' && size + 1u < MICROROS_GRAPH_NAME_SIZE) {
    if (endpoints_begins(from)) {
      from = &from[sizeof(in_dds) - 1u];
    } else if (*from == ':') {
      type[size] = '/';
      ++size;
      from = &from[2];
    } else {
      type[size] = *from;
      ++size;
      ++from;
    }
  }
  type[size - 1u] = '\0'; /* in place of the underscore */
}

rcl_ret_t rcl_graph_list_endpoints(
  rcl_graph_kind_t kind, char * topic, rcutils_allocator_t * allocator,
  rcl_topic_endpoint_info_array_t * into)
{
  static const rcl_graph_scanner_t scanner = {endpoints_scan, endpoints_drop};
  endpoints_list_t list = {topic, "", allocator, into, 0, kind};
  const rcl_ret_t result = endpoints_check(topic);

  return result == RCL_RET_OK ? rcl_graph_scan(&scanner, &list, NULL) : result;
}

static rcl_ret_t endpoints_count(
  rcl_graph_kind_t kind, const char * name, const char * type, const rcl_waiting_t * limit, size_t * count)
{
  static const rcl_graph_scanner_t scanner = {endpoints_scan, endpoints_drop};
  endpoints_list_t list = {name, type, NULL, NULL, 0, kind};
  rcl_ret_t result = endpoints_check(name);

  if (result == RCL_RET_OK) {
    result = rcl_graph_scan(&scanner, &list, limit);
  }
  if (result == RCL_RET_OK) {
    *count = list.count;
  }
  return result;
}

rcl_ret_t rcl_graph_count_named(
  rcl_graph_kind_t kind, char * name, const rcl_waiting_t * limit, size_t * count)
{
  return endpoints_count(kind, name, "", limit, count);
}

/* DDS also decides by QoS, which the message does not have: all endpoints of the own type count. */
rcl_ret_t rcl_graph_count_matched(rcl_graph_kind_t kind, const xrce_endpoint_t * own, size_t * count)
{
  char type[MICROROS_GRAPH_NAME_SIZE];

  endpoints_write_type(own->type->dds_type_name, type);
  return endpoints_count(kind, own->name, type, NULL, count);
}
