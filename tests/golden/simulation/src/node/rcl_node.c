/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/node.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rcl_names_expand.h"
#include "microros/rcl_names_given.h"
#include "microros/rcl_node_open.h"
#include "microros/rmw_node.h"
#include "microros/text.h"
#include "microros/xrce_client.h"
#include "microros/rcl_clock_source.h"
#include "rcl/expand_topic_name.h"
#include "rcl/node_options.h"

#include <stddef.h>
#include <string.h>

rcl_node_t rcl_get_zero_initialized_node(void)
{
  const rcl_node_t node = {NULL, NULL};

  return node;
}

static rcl_ret_t node_check_names(const char * name, const char * namespace_)
{
  const char * fault = rcl_names_given_node(name);

  if (fault != NULL) {
    microros_error_set(microros_error_name, name, fault, 0, 0);
    return RCL_RET_NODE_INVALID_NAME;
  }
  fault = rcl_names_given_namespace(namespace_);
  if (fault != NULL) {
    microros_error_set(microros_error_name, namespace_, fault, 0, 0);
    return RCL_RET_NODE_INVALID_NAMESPACE;
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_node_open(
  rcl_node_t * node, const char * name, const char * namespace_, rcl_context_t * context)
{
  rcl_ret_t result;

  if (node == NULL || name == NULL || namespace_ == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "node or its name");
  }
  if (!rcl_context_is_valid(context)) {
    return microros_error_refuse(RCL_RET_NOT_INIT, "context");
  }
  result = node_check_names(name, namespace_);
  if (result == RCL_RET_OK) {
    result = rmw_node_open(context->impl, name, namespace_, &node->impl);
  }
  if (result == RCL_RET_OK) {
    node->context = context;
    result = rcl_clock_source_open(node);
    if (result != RCL_RET_OK) {
      (void)rcl_node_fini(node); /* cannot fail: just opened */
      return result;
    }
  }
  return result;
}

rcl_ret_t rcl_node_init(
  rcl_node_t * node, const char * name, const char * namespace_, rcl_context_t * context,
  const rcl_node_options_t * options)
{
  if (context == NULL || options == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "context or options");
  }
  if (node != NULL && node->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_node_open, name);
  }
  return rcl_node_open(node, name, namespace_, context);
}

rcl_ret_t rcl_node_fini(rcl_node_t * node)
{
  if (node == NULL) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (rcl_node_is_valid(node)) {
    rcl_clock_source_close(node);
    rmw_node_close(node->impl);
  }
  node->impl = NULL;
  node->context = NULL;
  return RCL_RET_OK;
}

bool rcl_node_is_valid_except_context(const rcl_node_t * node)
{
  return node != NULL && node->impl != NULL;
}

bool rcl_node_is_valid(const rcl_node_t * node)
{
  return node != NULL && rmw_node_is_open(node->impl); /* which implies an open session and context */
}

const char * rcl_node_get_name(const rcl_node_t * node)
{
  return rcl_node_is_valid_except_context(node) ? node->impl->name : NULL;
}

const char * rcl_node_get_namespace(const rcl_node_t * node)
{
  return rcl_node_is_valid_except_context(node) ? node->impl->namespace_ : NULL;
}

rcl_ret_t rcl_node_get_domain_id(const rcl_node_t * node, size_t * domain_id)
{
  const xrce_participant_t * participant;

  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (domain_id == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "domain_id");
  }
  participant = node->impl->data;
  *domain_id = participant->domain_id;
  return RCL_RET_OK;
}

rmw_node_t * rcl_node_get_rmw_handle(const rcl_node_t * node)
{
  return rcl_node_is_valid_except_context(node) ? node->impl : NULL;
}

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

rcl_node_options_t rcl_node_get_default_options(void)
{
  rcl_node_options_t options;

  (void)memset(&options, 0, sizeof(options));
  options.allocator = rcl_get_default_allocator();
  options.use_global_arguments = true;
  return options;
}

rcl_ret_t rcl_node_options_copy(const rcl_node_options_t * options, rcl_node_options_t * options_out)
{
  if (options == NULL || options_out == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "options");
  }
  *options_out = *options;
  return RCL_RET_OK;
}

rcl_ret_t rcl_node_options_fini(rcl_node_options_t * options)
{
  if (options == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "options");
  }
  return RCL_RET_OK;
}

/* Writes `namespace.name`, of a namespace that begins with a slash; one `/` separates others. */
static void logger_name_write(char * text, const char * namespace_, const char * name)
{
  size_t used = 0;

  for (const char * next = &namespace_[1]; *next != '\0' && used + 1u < MICROROS_NODE_LOGGER_NAME_SIZE;
       ++next) {
    text[used] = *next == '/' ? '.' : *next;
    ++used;
  }
  text[used] = '.';
  for (const char * next = name; *next != '\0' && used + 2u < MICROROS_NODE_LOGGER_NAME_SIZE; ++next) {
    ++used;
    text[used] = *next;
  }
  text[used + 1u] = '\0';
}

const char * rcl_node_get_logger_name(const rcl_node_t * node)
{
  static char names[MICROROS_NODES_MAX][MICROROS_NODE_LOGGER_NAME_SIZE];
  char * text = NULL;

  if (!rcl_node_is_valid(node)) {
    return NULL;
  }
  if (node->impl->namespace_[1] == '\0') {
    return node->impl->name;
  }
  microros_lock();
  text = names[rmw_node_index(node->impl)];
  logger_name_write(text, node->impl->namespace_, node->impl->name);
  microros_unlock();
  return text;
}
