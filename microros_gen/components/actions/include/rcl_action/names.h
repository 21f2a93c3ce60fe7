/* SPDX-License-Identifier: Apache-2.0 */
/* The names of the services and topics of an action. */
#ifndef MICROROS_RCL_ACTION_NAMES_H
#define MICROROS_RCL_ACTION_NAMES_H

#include "rcl/allocator.h"
#include "rcl/macros.h"
#include "rcl/types.h"
#include "rcl_action/types.h"
#include "rcl_action/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Set *name, which is NULL before, to the name of a service or topic of the action. It is memory of the allocator, which
 * the caller deallocates. RCL_RET_INVALID_ARGUMENT for NULL and for an invalid allocator; RCL_RET_ACTION_NAME_INVALID for an
 * empty name; RCL_RET_BAD_ALLOC if the allocator has no memory: for the default one `memory: {arena: N}` of the application
 * file.
 */
rcl_ret_t rcl_action_get_goal_service_name(
  const char * action_name, rcl_allocator_t allocator, char ** goal_service_name);
rcl_ret_t rcl_action_get_cancel_service_name(
  const char * action_name, rcl_allocator_t allocator, char ** cancel_service_name);
rcl_ret_t rcl_action_get_result_service_name(
  const char * action_name, rcl_allocator_t allocator, char ** result_service_name);
rcl_ret_t rcl_action_get_feedback_topic_name(
  const char * action_name, rcl_allocator_t allocator, char ** feedback_topic_name);
rcl_ret_t rcl_action_get_status_topic_name(
  const char * action_name, rcl_allocator_t allocator, char ** status_topic_name);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ACTION_NAMES_H */
