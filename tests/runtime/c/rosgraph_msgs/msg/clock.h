/* SPDX-License-Identifier: Apache-2.0 */
/* rosgraph_msgs/msg/Clock, as the generator would lay it out; types_clock.c has its decoder. */
#ifndef ROSGRAPH_MSGS_MSG_CLOCK_H
#define ROSGRAPH_MSGS_MSG_CLOCK_H

#include "rosidl_runtime_c/message_type_support_struct.h"

#include <stdint.h>

typedef struct rosgraph_msgs__msg__Clock {
  struct {
    int32_t sec;
    uint32_t nanosec;
  } clock;
} rosgraph_msgs__msg__Clock;

const rosidl_message_type_support_t *
rosidl_typesupport_c__get_message_type_support_handle__rosgraph_msgs__msg__Clock(void);

#endif /* ROSGRAPH_MSGS_MSG_CLOCK_H */
