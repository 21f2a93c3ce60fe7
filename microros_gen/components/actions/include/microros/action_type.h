/* SPDX-License-Identifier: Apache-2.0 */
/* Action type as the runtime sees it: what differs from one action to another. */
#ifndef MICROROS_ACTION_TYPE_H
#define MICROROS_ACTION_TYPE_H

#include "microros/flash.h"
#include "rosidl_runtime_c/message_type_support_struct.h"

/* The names are those of the service types, "example_interfaces::action::dds_::Fibonacci_SendGoal_". */
typedef struct microros_action_type_t {
  const MICROROS_FLASH char * dds_type_name; /* "example_interfaces::action::dds_::Fibonacci_" */
  const MICROROS_FLASH char * send_goal;
  const MICROROS_FLASH char * get_result;
  const rosidl_message_type_support_t * goal_request;
  const rosidl_message_type_support_t * result_response;
  const rosidl_message_type_support_t * feedback;
} microros_action_type_t;

#endif /* MICROROS_ACTION_TYPE_H */
