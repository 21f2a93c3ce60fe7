/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Transforms between frames, published as tf2_ros does: on /tf what moves, on /tf_static what does not. Both publishers
 * belong to the first node of the application file, which declares neither; there is one broadcaster of each kind.
 *
 * A transform has its place in its own message: `header.frame_id` is the parent, `child_frame_id` the frame. Transforms
 * that tf2 would ignore are refused: names that are empty, begin with '/', or are equal. One task calls the functions of
 * a broadcaster; none allocates.
 */
#ifndef MICROROS_RCLC_TF_RCLC_TF_H
#define MICROROS_RCLC_TF_RCLC_TF_H

#include <stdbool.h>
#include <stddef.h>

#include "geometry_msgs/msg/transform_stamped.h"
#include "rcl/error_handling.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "tf2_msgs/msg/tf_message.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The broadcaster of /tf. */
typedef struct rclc_tf_broadcaster_t {
  rcl_publisher_t publisher;
} rclc_tf_broadcaster_t;

/* The broadcaster of /tf_static, with copies of all its transforms. Its members are internal; do not move or copy the
 * struct after its initialization. */
typedef struct rclc_static_tf_broadcaster_t {
  rcl_publisher_t publisher;
  tf2_msgs__msg__TFMessage message;
  tf2_msgs__msg__TFMessage__Storage storage;
  bool is_due;
} rclc_static_tf_broadcaster_t;

/*
 * Writes the names of both frames into a transform. The texts stay the caller's and have to outlive it. Stamp and
 * transform are set by the caller. RCL_RET_INVALID_ARGUMENT for NULL. */
rcl_ret_t rclc_tf_set_frames(
  geometry_msgs__msg__TransformStamped * transform, char * frame_id, char * child_frame_id);

/* Opens the publisher of /tf, and waits for the agent. The codes are those of rclc_publisher_init. */
rcl_ret_t rclc_tf_broadcaster_init(rclc_tf_broadcaster_t * broadcaster, const rcl_node_t * node);

/* Closes it, before its node is closed. */
rcl_ret_t rclc_tf_broadcaster_fini(rclc_tf_broadcaster_t * broadcaster, rcl_node_t * node);

/*
 * Publishes `count` transforms in one message, at most as many as the limits of tf2_msgs/msg/TFMessage say. They are
 * only read, and are the caller's again when the function returns. The codes are those of rcl_publish, and:
 *   RCL_RET_INVALID_ARGUMENT   NULL, no transform, or one that tf2 would ignore
 */
rcl_ret_t rclc_tf_broadcaster_send(
  const rclc_tf_broadcaster_t * broadcaster, geometry_msgs__msg__TransformStamped * transforms, size_t count);

/* Opens the publisher of /tf_static, and waits for the agent. The codes are those of rclc_publisher_init. */
rcl_ret_t rclc_static_tf_broadcaster_init(
  rclc_static_tf_broadcaster_t * broadcaster, const rcl_node_t * node);

/* Closes it, before its node is closed. Subscribers keep what they have. */
rcl_ret_t rclc_static_tf_broadcaster_fini(rclc_static_tf_broadcaster_t * broadcaster, rcl_node_t * node);

/*
 * Adds `count` transforms, or replaces those of the same child frame; after an error nothing has changed. All of them
 * are published in one message: now, or as soon as there are a session and room in the stream, and once more after the
 * agent has restarted, which forgets what late subscribers are to get. The arguments are copied.
 *   RCL_RET_PUBLISHER_INVALID  not initialized
 *   RCL_RET_INVALID_ARGUMENT   NULL, no transform, one that tf2 would ignore, or a name above the limit
 *   RCL_RET_BAD_ALLOC          more frames than the limits of tf2_msgs/msg/TFMessage say
 */
rcl_ret_t rclc_static_tf_broadcaster_send(
  rclc_static_tf_broadcaster_t * broadcaster, const geometry_msgs__msg__TransformStamped * transforms,
  size_t count);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_TF_RCLC_TF_H */
