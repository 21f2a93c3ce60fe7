/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rcl_names_expand.h"
#include "microros/text.h"
#include "rcl/expand_topic_name.h"
#include "rcl/node.h"

#include <string.h>

static rcl_ret_t resolve_expand(
  const rcl_node_t * node, const char * topic, const rcl_allocator_t * allocator, char ** name)
{
  const rcutils_string_map_t none = rcutils_get_zero_initialized_string_map();
  const char * fault;
  rcl_ret_t result = rcl_expand_topic_name(
    topic, rcl_node_get_name(node), rcl_node_get_namespace(node), &none, *allocator, name);

  if (result != RCL_RET_OK) {
    return result;
  }
  fault = rcl_names_check_full(*name, microros_text_size(*name));
  if (fault != NULL) {
    microros_error_set(microros_error_name, *name, fault, 0, 0);
    allocator->deallocate(*name, allocator->state);
    result = RCL_RET_TOPIC_NAME_INVALID;
  }
  return result;
}

rcl_ret_t rcl_node_resolve_name(
  const rcl_node_t * node, const char * input_topic_name, rcl_allocator_t allocator, bool is_service,
  bool only_expand, char ** output_topic_name)
{
  char * name = NULL;
  rcl_ret_t result;

  if (node == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "node");
  }
  if (!rcl_node_is_valid_except_context(node) || !rcutils_allocator_is_valid(&allocator)) {
    return microros_error_refuse(RCL_RET_ERROR, "node or allocator");
  }
  if (input_topic_name == NULL || output_topic_name == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "input_topic_name or output_topic_name");
  }
  result = resolve_expand(node, input_topic_name, &allocator, &name);
  (void)only_expand; /* no name is remapped */
  if (result == RCL_RET_OK) {
    *output_topic_name = name;
  }
  return result == RCL_RET_TOPIC_NAME_INVALID && is_service ? RCL_RET_SERVICE_NAME_INVALID : result;
}
