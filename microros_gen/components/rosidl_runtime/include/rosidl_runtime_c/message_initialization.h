/* SPDX-License-Identifier: Apache-2.0 */
/* Mode of initialization of a message, used by ROS 2's C++ generator; for sources that mention it. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_MESSAGE_INITIALIZATION_H
#define MICROROS_ROSIDL_RUNTIME_C_MESSAGE_INITIALIZATION_H

enum rosidl_runtime_c__message_initialization {
  ROSIDL_RUNTIME_C_MSG_INIT_ALL,
  ROSIDL_RUNTIME_C_MSG_INIT_SKIP,
  ROSIDL_RUNTIME_C_MSG_INIT_ZERO,
  ROSIDL_RUNTIME_C_MSG_INIT_DEFAULTS_ONLY
};

#endif /* MICROROS_ROSIDL_RUNTIME_C_MESSAGE_INITIALIZATION_H */
