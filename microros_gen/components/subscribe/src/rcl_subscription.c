/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/subscription.h"

#include "microros/error.h"
#include "microros/rcl_names_take.h"
#include "microros/rcl_subscription_open.h"
#include "microros/rmw_loan.h"
#include "microros/rmw_subscription.h"

#include <string.h>

rcl_subscription_t rcl_get_zero_initialized_subscription(void)
{
  const rcl_subscription_t subscription = {NULL};

  return subscription;
}

rcl_subscription_options_t rcl_subscription_get_default_options(void)
{
  rcl_subscription_options_t options;

  (void)memset(&options, 0, sizeof(options));
  options.qos = rmw_qos_profile_default;
  options.allocator = rcl_get_default_allocator();
  return options;
}

/* cppcheck-suppress constParameter ; the signature is that of ROS 2 */
rcl_ret_t rcl_subscription_options_fini(rcl_subscription_options_t * option)
{
  if (option == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "option");
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_subscription_open(
  rcl_subscription_t * subscription, const rcl_node_t * node,
  const rosidl_message_type_support_t * type_support, const char * topic_name, const rmw_qos_profile_t * qos)
{
  rcl_names_topic_t taken;
  const char * fault;

  if (subscription == NULL || type_support == NULL || topic_name == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "subscription, type or topic");
  }
  if (!rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  fault = rcl_names_take(&taken, topic_name, node->impl);
  if (fault != NULL) {
    microros_error_set(microros_error_name, topic_name, fault, 0, 0);
    return RCL_RET_TOPIC_NAME_INVALID;
  }
  return rmw_subscription_open(node->impl, type_support, taken.name, qos, &subscription->impl);
}

rcl_ret_t rcl_subscription_init(
  rcl_subscription_t * subscription, const rcl_node_t * node,
  const rosidl_message_type_support_t * type_support, const char * topic_name,
  const rcl_subscription_options_t * options)
{
  if (options == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "options");
  }
  if (subscription != NULL && subscription->impl != NULL) {
    return microros_error_named(RCL_RET_ALREADY_INIT, microros_error_subscription_open, topic_name);
  }
  if (subscription != NULL && !rcl_node_is_valid(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node"); /* checked first, as in rcl */
  }
  return rcl_subscription_open(subscription, node, type_support, topic_name, &options->qos);
}

rcl_ret_t rcl_subscription_fini(rcl_subscription_t * subscription, rcl_node_t * node)
{
  if (subscription == NULL) {
    return microros_error_refuse(RCL_RET_SUBSCRIPTION_INVALID, "subscription");
  }
  if (!rcl_node_is_valid_except_context(node)) {
    return microros_error_refuse(RCL_RET_NODE_INVALID, "node");
  }
  if (rmw_subscription_is_open(subscription->impl)) {
    rmw_subscription_close(subscription->impl);
  }
  subscription->impl = NULL;
  return RCL_RET_OK;
}

bool rcl_subscription_is_valid(const rcl_subscription_t * subscription)
{
  if (subscription == NULL) {
    return false;
  }
  return rmw_subscription_is_open(subscription->impl);
}

const char * rcl_subscription_get_topic_name(const rcl_subscription_t * subscription)
{
  return rcl_subscription_is_valid(subscription) ? subscription->impl->topic_name : NULL;
}

rmw_subscription_t * rcl_subscription_get_rmw_handle(const rcl_subscription_t * subscription)
{
  return rcl_subscription_is_valid(subscription) ? subscription->impl : NULL;
}

bool rcl_subscription_is_cft_enabled(const rcl_subscription_t * subscription)
{
  (void)subscription;
  return false;
}

bool rcl_subscription_can_loan_messages(const rcl_subscription_t * subscription)
{
  return subscription != NULL && rmw_loan_is_possible(subscription->impl);
}
