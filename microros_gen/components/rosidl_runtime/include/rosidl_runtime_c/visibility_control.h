/* SPDX-License-Identifier: Apache-2.0 */
/* A static library exports everything: these are empty, and exist for sources that write them. */
#ifndef MICROROS_ROSIDL_RUNTIME_C_VISIBILITY_CONTROL_H
#define MICROROS_ROSIDL_RUNTIME_C_VISIBILITY_CONTROL_H

#define ROSIDL_GENERATOR_C_EXPORT
#define ROSIDL_GENERATOR_C_IMPORT
#define ROSIDL_GENERATOR_C_PUBLIC
#define ROSIDL_GENERATOR_C_PUBLIC_TYPE
#define ROSIDL_GENERATOR_C_LOCAL

#endif /* MICROROS_ROSIDL_RUNTIME_C_VISIBILITY_CONTROL_H */
