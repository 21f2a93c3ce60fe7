/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/expand_topic_name.h"

#include "microros/error.h"
#include "microros/rcl_names.h"
#include "microros/rcl_names_expand.h"
#include "microros/text.h"
#include "rcl/validate_topic_name.h"

static const char * expand_lookup(const void * values, const char * key, size_t size)
{
  return rcutils_string_map_getn(values, key, size);
}

static rcl_ret_t expand_refuse(rcl_ret_t result, const char * name, const char * fault)
{
  microros_error_set(microros_error_name, name, fault, 0, 0);
  return result;
}

static rcl_ret_t expand_check(const char * topic, const char * node, const char * namespace_)
{
  int validation = RCL_TOPIC_NAME_VALID;
  const rcl_ret_t result = rcl_validate_topic_name(topic, &validation, NULL);
  const char * fault;

  if (result != RCL_RET_OK) {
    return result;
  }
  if (validation != RCL_TOPIC_NAME_VALID) {
    return expand_refuse(
      RCL_RET_TOPIC_NAME_INVALID, topic, rcl_topic_name_validation_result_string(validation));
  }
  fault = rcl_names_check_node(node);
  if (fault == NULL && microros_text_size(node) >= (size_t)RCL_NAMES_NODE_SIZE) {
    fault = "more than 255 bytes";
  }
  if (fault != NULL) {
    return expand_refuse(RCL_RET_NODE_INVALID_NAME, node, fault);
  }
  fault = namespace_[0] == '/' ? rcl_names_check_namespace(namespace_) : "it does not begin with a slash";
  if (fault == NULL && microros_text_size(namespace_) >= (size_t)RCL_NAMES_NAMESPACE_SIZE) {
    fault = "more than 245 bytes";
  }
  return fault == NULL ? RCL_RET_OK : expand_refuse(RCL_RET_NODE_INVALID_NAMESPACE, namespace_, fault);
}

rcl_ret_t rcl_expand_topic_name(
  const char * input_topic_name, const char * node_name, const char * node_namespace,
  const rcutils_string_map_t * substitutions, rcl_allocator_t allocator, char ** output_topic_name)
{
  const rcl_names_scope_t scope = {node_name, node_namespace, expand_lookup, substitutions};
  rcl_ret_t result;
  size_t size;
  char * full;

  if (
    input_topic_name == NULL || node_name == NULL || node_namespace == NULL || substitutions == NULL ||
    output_topic_name == NULL || !rcutils_allocator_is_valid(&allocator)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "a name, substitutions, allocator or output");
  }
  result = expand_check(input_topic_name, node_name, node_namespace);
  if (result != RCL_RET_OK) {
    return result;
  }
  size = rcl_names_expand(input_topic_name, &scope, NULL, 0);
  if (size == 0u) {
    return expand_refuse(RCL_RET_UNKNOWN_SUBSTITUTION, input_topic_name, "an unknown substitution");
  }
  full = allocator.allocate(size + 1u, allocator.state);
  if (full == NULL) {
    microros_error_set(microros_error_memory_given, NULL, NULL, (uint32_t)size + 1u, 0);
    return RCL_RET_BAD_ALLOC;
  }
  (void)rcl_names_expand(input_topic_name, &scope, full, size + 1u);
  *output_topic_name = full;
  return RCL_RET_OK;
}

/* cppcheck-suppress constParameter ; the signature is that of ROS 2 */
rcl_ret_t rcl_get_default_topic_name_substitutions(rcutils_string_map_t * string_map)
{
  if (string_map == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "string_map");
  }
  return RCL_RET_OK;
}
