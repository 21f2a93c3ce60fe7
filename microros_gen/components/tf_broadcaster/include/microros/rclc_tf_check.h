/* SPDX-License-Identifier: Apache-2.0 */
/* What both broadcasters check. Internal. */
#ifndef MICROROS_RCLC_TF_CHECK_H
#define MICROROS_RCLC_TF_CHECK_H

#include <stddef.h>

#include "rclc_tf/rclc_tf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns RCL_RET_OK for transforms that tf2 takes, otherwise RCL_RET_INVALID_ARGUMENT with a text. */
rcl_ret_t rclc_tf_check(const geometry_msgs__msg__TransformStamped * transforms, size_t count);

/* Returns whether two names are equal; `size` of each is its length. */
bool rclc_tf_is_same(const rosidl_runtime_c__String * one, const rosidl_runtime_c__String * other);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_TF_CHECK_H */
