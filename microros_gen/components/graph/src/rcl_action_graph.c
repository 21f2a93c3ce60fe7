/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_action/graph.h"

#include "microros/text.h"

/* Cuts `end` off a text; returns false, with nothing changed, if the text does not end with it. */
static bool action_graph_cut(char * text, const char * end)
{
  const size_t size = microros_text_size(text);
  const size_t end_size = microros_text_size(end);

  if (size < end_size || !microros_text_equals(&text[size - end_size], end)) {
    return false;
  }
  text[size - end_size] = '\0';
  return true;
}

/* Moves topic `from` to place `to` as an action; returns false if it belongs to none, and frees it. */
static bool action_graph_move(rcl_names_and_types_t * list, size_t from, size_t to)
{
  static const char feedback_name[] = "/_action/feedback"; /* each action has this topic */
  static const char feedback_type[] = "_FeedbackMessage";
  char * name = list->names.data[from];
  rcutils_string_array_t types = list->types[from];

  list->names.data[from] = NULL;
  list->types[from] = rcutils_get_zero_initialized_string_array();
  if (!action_graph_cut(name, feedback_name)) {
    list->names.allocator.deallocate(name, list->names.allocator.state);
    (void)rcutils_string_array_fini(&types); /* cannot fail: it was made with a valid allocator */
    return false;
  }
  for (size_t i = 0; i < types.size; ++i) {
    (void)action_graph_cut(types.data[i], feedback_type); /* another type stays as it is, as in ROS 2 */
  }
  list->names.data[to] = name;
  list->types[to] = types;
  return true;
}

static rcl_ret_t action_graph_filter(rcl_names_and_types_t * list)
{
  size_t actions = 0;

  for (size_t i = 0; i < list->names.size; ++i) {
    if (action_graph_move(list, i, actions)) {
      ++actions;
    }
  }
  if (actions == 0u) {
    return rcl_names_and_types_fini(list);
  }
  list->names.size = actions;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_get_client_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * node_name, const char * node_namespace,
  rcl_names_and_types_t * action_names_and_types)
{
  const rcl_ret_t result = rcl_get_subscriber_names_and_types_by_node(
    node, allocator, false, node_name, node_namespace, action_names_and_types);

  return result == RCL_RET_OK ? action_graph_filter(action_names_and_types) : result;
}

rcl_ret_t rcl_action_get_server_names_and_types_by_node(
  const rcl_node_t * node, rcl_allocator_t * allocator, const char * node_name, const char * node_namespace,
  rcl_names_and_types_t * action_names_and_types)
{
  const rcl_ret_t result = rcl_get_publisher_names_and_types_by_node(
    node, allocator, false, node_name, node_namespace, action_names_and_types);

  return result == RCL_RET_OK ? action_graph_filter(action_names_and_types) : result;
}

rcl_ret_t rcl_action_get_names_and_types(
  const rcl_node_t * node, rcl_allocator_t * allocator, rcl_names_and_types_t * action_names_and_types)
{
  const rcl_ret_t result = rcl_get_topic_names_and_types(node, allocator, false, action_names_and_types);

  return result == RCL_RET_OK ? action_graph_filter(action_names_and_types) : result;
}
