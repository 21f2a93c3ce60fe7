/* SPDX-License-Identifier: Apache-2.0 */
/* How a message is initialized; the C++ generator of ROS 2 takes it, kept for sources that name it. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_MESSAGE_INITIALIZATION_H
#define MICROROS_ROSIDL_RUNTIME_C_MESSAGE_INITIALIZATION_H

enum rosidl_runtime_c__message_initialization {
  ROSIDL_RUNTIME_C_MSG_INIT_ALL,
  ROSIDL_RUNTIME_C_MSG_INIT_SKIP,
  ROSIDL_RUNTIME_C_MSG_INIT_ZERO,
  ROSIDL_RUNTIME_C_MSG_INIT_DEFAULTS_ONLY
};

#endif /* MICROROS_ROSIDL_RUNTIME_C_MESSAGE_INITIALIZATION_H */
