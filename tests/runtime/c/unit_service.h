/* SPDX-License-Identifier: Apache-2.0 */
/* A service of Int32 for programs that have no service among their interfaces. */
#ifndef UNIT_SERVICE_H
#define UNIT_SERVICE_H

#include "microros/message_type.h"
#include "microros/service_type.h"
#include "types.h"

#include <rosidl_runtime_c/service_type_support_struct.h>

static microros_message_type_t unit_request_type;
static microros_message_type_t unit_response_type;
static const microros_service_type_t unit_service_type = {
  "test::srv::dds_::Ask_", &unit_request_type, &unit_response_type};
static const rosidl_service_type_support_t ask = {"microros", &unit_service_type};

/* Call it before the service is opened. */
static inline void ask_begin(void)
{
  const microros_message_type_t * int32 = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32)->data;

  unit_request_type = *int32;
  unit_request_type.dds_type_name = "test::srv::dds_::Ask_Request_";
  unit_response_type = *int32;
  unit_response_type.dds_type_name = "test::srv::dds_::Ask_Response_";
}

#endif /* UNIT_SERVICE_H */
