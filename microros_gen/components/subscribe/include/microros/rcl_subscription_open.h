/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shared by rclc and rcl: opens a subscription with a QoS. Internal; pointers except `qos` are already
 * checked. */
#ifndef MICROROS_RCL_SUBSCRIPTION_OPEN_H
#define MICROROS_RCL_SUBSCRIPTION_OPEN_H

#include "rcl/subscription.h"

#ifdef __cplusplus
extern "C" {
#endif

rcl_ret_t rcl_subscription_open(
  rcl_subscription_t * subscription, const rcl_node_t * node,
  const rosidl_message_type_support_t * type_support, const char * topic_name, const rmw_qos_profile_t * qos);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_SUBSCRIPTION_OPEN_H */
