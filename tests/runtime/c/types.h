/* SPDX-License-Identifier: Apache-2.0 */
/* std_msgs/msg/Int32 and String, written by hand as the generator would. A String has up to 8 bytes. */
#ifndef TYPES_H
#define TYPES_H

#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/string.h"

#include <stdint.h>

typedef struct std_msgs__msg__Int32 {
  int32_t data;
} std_msgs__msg__Int32;

typedef struct std_msgs__msg__String {
  rosidl_runtime_c__String data;
} std_msgs__msg__String;

const rosidl_message_type_support_t *
rosidl_typesupport_c__get_message_type_support_handle__std_msgs__msg__Int32(void);
const rosidl_message_type_support_t *
rosidl_typesupport_c__get_message_type_support_handle__std_msgs__msg__String(void);

#endif /* TYPES_H */
