/* SPDX-License-Identifier: Apache-2.0 */
/* Names of the services and topics of an action. */
#include "microros/action_name.h"

#include "microros/error.h"
#include "microros/text.h"
#include "rcl_action/names.h"

#include <stddef.h>

bool rcl_action_is_named(const char * full, const rmw_name_t * name)
{
  static const char goal_part[] = "/_action/send_goal"; /* what ROS 2 appends for the goal service */
  size_t at = 0;

  for (size_t i = 0; i < sizeof(name->part) / sizeof(name->part[0]); ++i) {
    for (size_t from = 0; name->part[i][from] != '\0'; ++from) {
      if (full[at] != name->part[i][from]) {
        return false; /* also at the end of `full` */
      }
      ++at;
    }
  }
  return microros_text_equals(&full[at], goal_part);
}

static rcl_ret_t action_names_make(
  const char * action_name, const char * part, const rcl_allocator_t * allocator, char ** name)
{
  size_t size;
  size_t part_size;
  char * made;

  if (!rcutils_allocator_is_valid(allocator) || action_name == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "allocator or action_name");
  }
  if (action_name[0] == '\0') {
    return microros_error_refuse(RCL_RET_ACTION_NAME_INVALID, "action_name");
  }
  if (name == NULL || *name != NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "name");
  }
  size = microros_text_size(action_name);
  part_size = microros_text_size(part) + 1u;
  made = allocator->allocate(size + part_size, allocator->state);
  if (made == NULL) {
    return RCL_RET_BAD_ALLOC;
  }
  (void)memcpy(made, action_name, size);
  (void)memcpy(&made[size], part, part_size);
  *name = made;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_get_goal_service_name(
  const char * action_name, rcl_allocator_t allocator, char ** goal_service_name)
{
  return action_names_make(action_name, "/_action/send_goal", &allocator, goal_service_name);
}

rcl_ret_t rcl_action_get_cancel_service_name(
  const char * action_name, rcl_allocator_t allocator, char ** cancel_service_name)
{
  return action_names_make(action_name, "/_action/cancel_goal", &allocator, cancel_service_name);
}

rcl_ret_t rcl_action_get_result_service_name(
  const char * action_name, rcl_allocator_t allocator, char ** result_service_name)
{
  return action_names_make(action_name, "/_action/get_result", &allocator, result_service_name);
}

rcl_ret_t rcl_action_get_feedback_topic_name(
  const char * action_name, rcl_allocator_t allocator, char ** feedback_topic_name)
{
  return action_names_make(action_name, "/_action/feedback", &allocator, feedback_topic_name);
}

rcl_ret_t rcl_action_get_status_topic_name(
  const char * action_name, rcl_allocator_t allocator, char ** status_topic_name)
{
  return action_names_make(action_name, "/_action/status", &allocator, status_topic_name);
}
