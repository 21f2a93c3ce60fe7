/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/validate_topic_name.h"

#include "microros/error.h"
#include "microros/rcl_names.h"
#include "microros/rcl_names_expand.h"
#include "microros/text.h"
#include "rcl/expand_topic_name.h"

#include <stdbool.h>

/* State of the scan of a name. */
typedef struct topic_scan_t {
  size_t at;
  size_t brace; /* position of the substitution's brace */
  bool inside;  /* inside a substitution */
} topic_scan_t;

static bool topic_is_digit(char c)
{
  return c >= '0' && c <= '9';
}

static bool topic_is_word(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static int topic_check_brace(topic_scan_t * scan, char c)
{
  const bool opens = c == '{';

  if (opens == scan->inside) {
    return opens ? RCL_TOPIC_NAME_INVALID_SUBSTITUTION_CONTAINS_UNALLOWED_CHARACTERS
                 : RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE;
  }
  scan->inside = opens;
  scan->brace = scan->at;
  return RCL_TOPIC_NAME_VALID;
}

static int topic_check_character(topic_scan_t * scan, char c)
{
  if (topic_is_word(c)) {
    return RCL_TOPIC_NAME_VALID;
  }
  if (topic_is_digit(c)) {
    return scan->inside && scan->at == scan->brace + 1u
             ? RCL_TOPIC_NAME_INVALID_SUBSTITUTION_STARTS_WITH_NUMBER
             : RCL_TOPIC_NAME_VALID;
  }
  if (c == '~') {
    return scan->at != 0u ? RCL_TOPIC_NAME_INVALID_MISPLACED_TILDE : RCL_TOPIC_NAME_VALID;
  }
  if (c == '{' || c == '}') {
    return topic_check_brace(scan, c);
  }
  if (scan->inside) {
    return RCL_TOPIC_NAME_INVALID_SUBSTITUTION_CONTAINS_UNALLOWED_CHARACTERS;
  }
  return c == '/' ? RCL_TOPIC_NAME_VALID : RCL_TOPIC_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS;
}

static int topic_check_characters(const char * name, size_t size, size_t * index)
{
  topic_scan_t scan = {0, 0, false};

  for (; scan.at < size; ++scan.at) {
    const int result = topic_check_character(&scan, name[scan.at]);

    if (result != RCL_TOPIC_NAME_VALID) {
      *index = scan.at;
      return result;
    }
  }
  *index = scan.brace;
  return scan.inside ? RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE : RCL_TOPIC_NAME_VALID;
}

/* Checks the characters after each slash, and after ~. */
static int topic_check_parts(const char * name, size_t size, size_t * index)
{
  if (name[0] == '~' && size > 1u && name[1] != '/') {
    *index = 1;
    return RCL_TOPIC_NAME_INVALID_TILDE_NOT_FOLLOWED_BY_FORWARD_SLASH;
  }
  for (size_t i = 1; i < size; ++i) {
    if (name[i - 1u] == '/' && topic_is_digit(name[i])) {
      *index = i;
      return RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER;
    }
  }
  return RCL_TOPIC_NAME_VALID;
}

static int topic_check(const char * name, size_t size, size_t * index)
{
  int result;

  if (size == 0u) {
    return RCL_TOPIC_NAME_INVALID_IS_EMPTY_STRING;
  }
  if (topic_is_digit(name[0])) {
    return RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER;
  }
  if (name[size - 1u] == '/') {
    *index = size - 1u;
    return RCL_TOPIC_NAME_INVALID_ENDS_WITH_FORWARD_SLASH;
  }
  result = topic_check_characters(name, size, index);
  return result == RCL_TOPIC_NAME_VALID ? topic_check_parts(name, size, index) : result;
}

rcl_ret_t rcl_validate_topic_name_with_size(
  const char * topic_name, size_t topic_name_length, int * validation_result, size_t * invalid_index)
{
  size_t index = 0;

  if (topic_name == NULL || validation_result == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "topic_name or validation_result");
  }
  *validation_result = topic_check(topic_name, topic_name_length, &index);
  if (*validation_result != RCL_TOPIC_NAME_VALID && invalid_index != NULL) {
    *invalid_index = index;
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_validate_topic_name(const char * topic_name, int * validation_result, size_t * invalid_index)
{
  const size_t size = topic_name != NULL ? microros_text_size(topic_name) : 0u;

  return rcl_validate_topic_name_with_size(topic_name, size, validation_result, invalid_index);
}

const char * rcl_topic_name_validation_result_string(int validation_result)
{
  static const char * const words[] = {
    NULL,
    "it is empty",
    "a slash at its end",
    "only letters, digits and _ / ~ { }",
    "a part begins with a digit",
    "a brace without its other half",
    "~ after the first character",
    "no / after ~",
    "only letters, digits and _ in a substitution",
    "a substitution begins with a digit"};

  if (validation_result < 0 || (size_t)validation_result >= sizeof(words) / sizeof(words[0])) {
    return "no result of rcl_validate_topic_name";
  }
  return words[validation_result];
}

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
