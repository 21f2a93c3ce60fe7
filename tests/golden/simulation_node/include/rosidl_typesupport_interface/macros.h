/* SPDX-License-Identifier: Apache-2.0 */
/* Names of the functions that return a type's handle, as ROS 2 spells them. */
#ifndef MICROROS_ROSIDL_TYPESUPPORT_INTERFACE_MACROS_H
#define MICROROS_ROSIDL_TYPESUPPORT_INTERFACE_MACROS_H

#define ROSIDL_TYPESUPPORT_INTERFACE__SYMBOL_NAME(typesupport, function, package, subfolder, name) \
  typesupport##__##function##__##package##__##subfolder##__##name

#define ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(typesupport, package, subfolder, name) \
  ROSIDL_TYPESUPPORT_INTERFACE__SYMBOL_NAME( \
    typesupport, get_message_type_support_handle, package, subfolder, name)

#define ROSIDL_TYPESUPPORT_INTERFACE__SERVICE_SYMBOL_NAME(typesupport, package, subfolder, name) \
  ROSIDL_TYPESUPPORT_INTERFACE__SYMBOL_NAME( \
    typesupport, get_service_type_support_handle, package, subfolder, name)

#define ROSIDL_TYPESUPPORT_INTERFACE__ACTION_SYMBOL_NAME(typesupport, package, subfolder, name) \
  ROSIDL_TYPESUPPORT_INTERFACE__SYMBOL_NAME( \
    typesupport, get_action_type_support_handle, package, subfolder, name)

#endif /* MICROROS_ROSIDL_TYPESUPPORT_INTERFACE_MACROS_H */
