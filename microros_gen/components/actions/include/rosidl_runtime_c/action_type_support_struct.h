/* SPDX-License-Identifier: Apache-2.0 */
/* The handle of an action type. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_ACTION_TYPE_SUPPORT_STRUCT_H
#define MICROROS_ROSIDL_RUNTIME_C_ACTION_TYPE_SUPPORT_STRUCT_H

#include "rosidl_runtime_c/visibility_control.h"
#include "rosidl_typesupport_interface/macros.h"

/* `data` points to a `const microros_action_type_t` (microros/action_type.h). Handles are constants. */
typedef struct rosidl_action_type_support_t {
  const char * typesupport_identifier;
  const void * data;
} rosidl_action_type_support_t;

/* An expression of type `const rosidl_action_type_support_t *`. */
#define ROSIDL_GET_ACTION_TYPE_SUPPORT(PkgName, Name) \
  ROSIDL_TYPESUPPORT_INTERFACE__ACTION_SYMBOL_NAME(rosidl_typesupport_c, PkgName, action, Name)()

#endif /* MICROROS_ROSIDL_RUNTIME_C_ACTION_TYPE_SUPPORT_STRUCT_H */
