/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/publisher.h"

#include "microros/error.h"
#include "microros/rcl_names_take.h"
#include "microros/rcl_publisher_open.h"
#include "microros/rmw_client.h"
#include "microros/rmw_publisher.h"
#include "microros/rmw_qos.h"
#include "microros/xrce_objects.h"
#include "rmw/rmw.h"

#include <stddef.h>
#include <string.h>

rcl_publisher_t rcl_get_zero_initialized_publisher(void)
{
  const rcl_publisher_t publisher = {NULL};

  return publisher;
}

rcl_publisher_options_t rcl_publisher_get_default_options(void)
{
  rcl_publisher_options_t options;

  (void)memset(&options, 0, sizeof(options));
  options.qos = rmw_qos_profile_default;
  options.allocator = rcl_get_default_allocator();
  return options;
}

rcl_ret_t rcl_publisher_open(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name, const rmw_qos_profile_t * qos)
{
  rcl_names_topic_t taken;
  const char * fault;

  if (publisher == NULL || type_support == NULL || topic_name == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "publisher, type or topic");
  }
  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  fault = rcl_names_take(&taken, topic_name, node->impl);
  if (fault != NULL) {
    microros_error_set(microros_error_name, topic_name, fault, 0, 0);
    return RCL_RET_TOPIC_NAME_INVALID;
  }
  return rmw_publisher_open(node->impl, type_support, taken.name, qos, &publisher->impl);
}

rcl_ret_t rcl_publisher_init(
  rcl_publisher_t * publisher, const rcl_node_t * node, const rosidl_message_type_support_t * type_support,
  const char * topic_name, const rcl_publisher_options_t * options)
{
  if (options == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "options");
  }
  if (publisher != NULL && publisher->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_publisher_open, topic_name);
  }
  if (publisher != NULL && !rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node"); /* checked first, as in rcl */
  }
  return rcl_publisher_open(publisher, node, type_support, topic_name, &options->qos);
}

rcl_ret_t rcl_publisher_fini(rcl_publisher_t * publisher, rcl_node_t * node)
{
  if (publisher == NULL) {
    return microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
  }
  if (!rcl_node_is_valid_except_context(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (rmw_publisher_is_open(publisher->impl)) {
    rmw_publisher_close(publisher->impl);
  }
  publisher->impl = NULL;
  return RCL_RET_OK;
}

bool rcl_publisher_is_valid(const rcl_publisher_t * publisher)
{
  return publisher != NULL && rmw_publisher_is_open(publisher->impl);
}

static rcl_ret_t publisher_refuse(void)
{
  return microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
}

rcl_ret_t rcl_publish(
  const rcl_publisher_t * publisher, const void * ros_message, rmw_publisher_allocation_t * allocation)
{
  (void)allocation;
  if (!rcl_publisher_is_valid(publisher)) {
    return publisher_refuse();
  }
  if (ros_message == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "message");
  }
  return rmw_publisher_write(publisher->impl, ros_message);
}

rcl_ret_t rcl_publish_serialized_message(
  const rcl_publisher_t * publisher, const rcl_serialized_message_t * serialized_message,
  rmw_publisher_allocation_t * allocation)
{
  if (!rcl_publisher_is_valid(publisher)) {
    return publisher_refuse();
  }
  return rmw_publish_serialized_message(publisher->impl, serialized_message, allocation);
}

rcl_ret_t rcl_publisher_wait_for_all_acked(const rcl_publisher_t * publisher, rcl_duration_value_t timeout)
{
  const xrce_endpoint_t * writer;
  uint32_t timeout_ms = UINT32_MAX;

  if (!rcl_publisher_is_valid(publisher)) {
    return publisher_refuse();
  }
  if (timeout >= 0 && RCL_NS_TO_MS(timeout) < (int64_t)UINT32_MAX) {
    timeout_ms = (uint32_t)RCL_NS_TO_MS(timeout);
  }
  writer = publisher->impl->data;
  return rmw_client_flush(writer->client, timeout_ms) ? RCL_RET_OK : RCL_RET_TIMEOUT;
}

const char * rcl_publisher_get_topic_name(const rcl_publisher_t * publisher)
{
  return rcl_publisher_is_valid(publisher) ? publisher->impl->topic_name : NULL;
}

rmw_publisher_t * rcl_publisher_get_rmw_handle(const rcl_publisher_t * publisher)
{
  return rcl_publisher_is_valid(publisher) ? publisher->impl : NULL;
}

bool rcl_publisher_is_valid_except_context(const rcl_publisher_t * publisher)
{
  return publisher != NULL && publisher->impl != NULL;
}

bool rcl_publisher_can_loan_messages(const rcl_publisher_t * publisher)
{
  (void)publisher;
  return false;
}

/* Nothing to do: every publisher is automatic, and the agent asserts it. Other kinds were refused at
 * creation. */
rcl_ret_t rcl_publisher_assert_liveliness(const rcl_publisher_t * publisher)
{
  if (!rcl_publisher_is_valid(publisher)) {
    return microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
  }
  return RCL_RET_OK;
}

const rmw_qos_profile_t * rcl_publisher_get_actual_qos(const rcl_publisher_t * publisher)
{
  static rmw_qos_profile_t profiles[MICROROS_PUBLISHERS_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rmw_qos_profile_t * profile;

  if (!rcl_publisher_is_valid(publisher)) {
    (void)microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
    return NULL;
  }
  endpoint = publisher->impl->data;
  profile = &profiles[endpoint->index];
  rmw_qos_actual(endpoint, profile);
  return profile;
}

const rcl_publisher_options_t * rcl_publisher_get_options(const rcl_publisher_t * publisher)
{
  static rcl_publisher_options_t options[MICROROS_PUBLISHERS_MAX]; /* indexed by place */
  const xrce_endpoint_t * endpoint;
  rcl_publisher_options_t * own;

  if (!rcl_publisher_is_valid(publisher)) {
    (void)microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
    return NULL;
  }
  endpoint = publisher->impl->data;
  own = &options[endpoint->index];
  own->allocator = rcl_get_default_allocator();
  rmw_qos_actual(endpoint, &own->qos);
  return own;
}
