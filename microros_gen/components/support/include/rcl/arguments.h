/* SPDX-License-Identifier: Apache-2.0 */
/* Command-line arguments, which a microcontroller does not have: accepted wherever ROS 2 takes them, and
 * not read. */
#ifndef MICROROS_RCL_ARGUMENTS_H
#define MICROROS_RCL_ARGUMENTS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_arguments_impl_s rcl_arguments_impl_t;

typedef struct rcl_arguments_s {
  rcl_arguments_impl_t * impl;
} rcl_arguments_t;

rcl_arguments_t rcl_get_zero_initialized_arguments(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_ARGUMENTS_H */
