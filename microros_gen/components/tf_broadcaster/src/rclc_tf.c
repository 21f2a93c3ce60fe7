/* SPDX-License-Identifier: Apache-2.0 */
#include "rclc_tf/rclc_tf.h"

#include "microros/error.h"
#include "microros/rclc_tf_check.h"
#include "microros/text.h"
#include "rclc/publisher.h"
#include "rmw/qos_profiles.h"

#include <string.h>

enum { TF_DEPTH = 100 }; /* as tf2_ros::DynamicBroadcasterQoS */

static void tf_lend(rosidl_runtime_c__String * string, char * text)
{
  string->data = text;
  string->size = microros_text_size(text);
  string->capacity = string->size + 1u;
}

rcl_ret_t rclc_tf_set_frames(
  geometry_msgs__msg__TransformStamped * transform, char * frame_id, char * child_frame_id)
{
  if (transform == NULL || frame_id == NULL || child_frame_id == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "transform, frame_id or child_frame_id");
  }
  tf_lend(&transform->header.frame_id, frame_id);
  tf_lend(&transform->child_frame_id, child_frame_id);
  return RCL_RET_OK;
}

bool rclc_tf_is_same(const rosidl_runtime_c__String * one, const rosidl_runtime_c__String * other)
{
  return one->size == other->size && strncmp(one->data, other->data, one->size) == 0;
}

static bool tf_is_name(const rosidl_runtime_c__String * name)
{
  return name->data != NULL && name->size != 0u && name->data[0] != '/';
}

rcl_ret_t rclc_tf_check(const geometry_msgs__msg__TransformStamped * transforms, size_t count)
{
  if (transforms == NULL || count == 0u) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "transforms or count");
  }
  for (size_t i = 0; i < count; ++i) {
    const rosidl_runtime_c__String * const child = &transforms[i].child_frame_id;

    if (!tf_is_name(child)) {
      microros_error_set(
        microros_error_tf, "", MICROROS_ERROR_WORDS("its name is empty or begins with '/'"), 0, 0);
      return RCL_RET_INVALID_ARGUMENT;
    }
    if (
      !tf_is_name(&transforms[i].header.frame_id) || rclc_tf_is_same(&transforms[i].header.frame_id, child)) {
      microros_error_set(
        microros_error_tf, child->data,
        MICROROS_ERROR_WORDS("the name of its parent is empty, begins with '/' or is its own"), 0, 0);
      return RCL_RET_INVALID_ARGUMENT;
    }
  }
  return RCL_RET_OK;
}

rcl_ret_t rclc_tf_broadcaster_init(rclc_tf_broadcaster_t * broadcaster, const rcl_node_t * node)
{
  rmw_qos_profile_t qos = rmw_qos_profile_default;

  if (broadcaster == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "broadcaster");
  }
  qos.depth = TF_DEPTH;
  return rclc_publisher_init(
    &broadcaster->publisher, node, ROSIDL_GET_MSG_TYPE_SUPPORT(tf2_msgs, msg, TFMessage), "/tf", &qos);
}

rcl_ret_t rclc_tf_broadcaster_fini(rclc_tf_broadcaster_t * broadcaster, rcl_node_t * node)
{
  return broadcaster != NULL ? rcl_publisher_fini(&broadcaster->publisher, node)
                             : microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "broadcaster");
}

rcl_ret_t rclc_tf_broadcaster_send(
  const rclc_tf_broadcaster_t * broadcaster, geometry_msgs__msg__TransformStamped * transforms, size_t count)
{
  const tf2_msgs__msg__TFMessage message = {{transforms, count, count}};
  rcl_ret_t result;

  if (broadcaster == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "broadcaster");
  }
  result = rclc_tf_check(transforms, count);
  return result == RCL_RET_OK ? rcl_publish(&broadcaster->publisher, &message, NULL) : result;
}
