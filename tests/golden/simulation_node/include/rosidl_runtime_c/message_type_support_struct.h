/* SPDX-License-Identifier: Apache-2.0 */
/* The handle of a message type. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_MESSAGE_TYPE_SUPPORT_STRUCT_H
#define MICROROS_ROSIDL_RUNTIME_C_MESSAGE_TYPE_SUPPORT_STRUCT_H

#include "rosidl_runtime_c/visibility_control.h"
#include "rosidl_typesupport_interface/macros.h"

/* `data` points to a `const microros_message_type_t` (microros/message_type.h). Handles are constants. */
typedef struct rosidl_message_type_support_t {
  const char * typesupport_identifier;
  const void * data;
} rosidl_message_type_support_t;

/* An expression of type `const rosidl_message_type_support_t *`. */
#define ROSIDL_GET_MSG_TYPE_SUPPORT(PkgName, MsgSubfolder, MsgName) \
  ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(rosidl_typesupport_c, PkgName, MsgSubfolder, MsgName)()

#endif /* MICROROS_ROSIDL_RUNTIME_C_MESSAGE_TYPE_SUPPORT_STRUCT_H */
