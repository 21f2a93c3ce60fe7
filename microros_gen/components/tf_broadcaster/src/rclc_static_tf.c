/* SPDX-License-Identifier: Apache-2.0 */
/* The message of /tf_static is kept: each new transform is sent with all others, as late subscribers get one sample. */
#include "microros/rclc_static_tf.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_tf_check.h"
#include "microros/rmw_publisher.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"
#include "rclc/publisher.h"
#include "rmw/qos_profiles.h"

#include <string.h>

enum { STATIC_TF_BODY = XRCE_SUBMESSAGE_HEADER + XRCE_OBJECT_PREFIX };

/* What is open; the struct is the application's. */
static rclc_static_tf_broadcaster_t * static_tf;

static void static_tf_use(rclc_static_tf_broadcaster_t * broadcaster)
{
  microros_lock();
  static_tf = broadcaster;
  microros_unlock();
}

rcl_ret_t rclc_static_tf_broadcaster_init(rclc_static_tf_broadcaster_t * broadcaster, const rcl_node_t * node)
{
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rcl_ret_t result;

  if (broadcaster == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "broadcaster");
  }
  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  qos.depth = 1;
  result = rclc_publisher_init(
    &broadcaster->publisher, node, ROSIDL_GET_MSG_TYPE_SUPPORT(tf2_msgs, msg, TFMessage), "/tf_static", &qos);
  if (result == RCL_RET_OK) {
    tf2_msgs__msg__TFMessage__bind(&broadcaster->message, &broadcaster->storage);
    broadcaster->message.transforms.size = 0;
    broadcaster->is_due = false;
    static_tf_use(broadcaster);
  }
  return result;
}

rcl_ret_t rclc_static_tf_broadcaster_fini(rclc_static_tf_broadcaster_t * broadcaster, rcl_node_t * node)
{
  rcl_ret_t result;

  if (broadcaster == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "broadcaster");
  }
  result = rcl_publisher_fini(&broadcaster->publisher, node);
  if (result == RCL_RET_OK && static_tf == broadcaster) {
    static_tf_use(NULL);
  }
  return result;
}

/* Returns the place of a child frame among `count` transforms; `count`: it has none. */
static size_t static_tf_find(
  const geometry_msgs__msg__TransformStamped * transforms, size_t count,
  const geometry_msgs__msg__TransformStamped * wanted)
{
  for (size_t i = 0; i < count; ++i) {
    if (rclc_tf_is_same(&transforms[i].child_frame_id, &wanted->child_frame_id)) {
      return i;
    }
  }
  return count;
}

static bool static_tf_fits(
  const geometry_msgs__msg__TransformStamped * place, const geometry_msgs__msg__TransformStamped * transform)
{
  return transform->header.frame_id.size < place->header.frame_id.capacity &&
         transform->child_frame_id.size < place->child_frame_id.capacity;
}

/* Returns the bytes of the longer name of the two frames. */
static uint32_t static_tf_longest(const geometry_msgs__msg__TransformStamped * transform)
{
  const size_t parent = transform->header.frame_id.size;
  const size_t child = transform->child_frame_id.size;

  return (uint32_t)(parent > child ? parent : child);
}

/* Returns whether all transforms have room; a text is set if not. */
static rcl_ret_t static_tf_check(
  const geometry_msgs__msg__TransformStamped__Sequence * kept,
  const geometry_msgs__msg__TransformStamped * transforms, size_t count)
{
  size_t size = kept->size;
  size_t last = 0;

  for (size_t i = 0; i < count; ++i) {
    if (!static_tf_fits(&kept->data[0], &transforms[i])) {
      microros_error_set(
        microros_error_tf_name, transforms[i].child_frame_id.data, NULL, static_tf_longest(&transforms[i]),
        0);
      return RCL_RET_INVALID_ARGUMENT;
    }
    if (
      static_tf_find(kept->data, kept->size, &transforms[i]) == kept->size &&
      static_tf_find(transforms, i, &transforms[i]) == i) {
      ++size;
      last = i;
    }
  }
  if (size <= kept->capacity) {
    return RCL_RET_OK;
  }
  microros_error_set(microros_error_tf_full, transforms[last].child_frame_id.data, NULL, (uint32_t)size, 0);
  return RCL_RET_BAD_ALLOC;
}

static void static_tf_copy_text(rosidl_runtime_c__String * to, const rosidl_runtime_c__String * from)
{
  (void)memcpy(to->data, from->data, from->size);
  to->data[from->size] = '\0';
  to->size = from->size;
}

static void static_tf_keep(
  geometry_msgs__msg__TransformStamped__Sequence * kept,
  const geometry_msgs__msg__TransformStamped * transform)
{
  const size_t index = static_tf_find(kept->data, kept->size, transform);
  geometry_msgs__msg__TransformStamped * const place = &kept->data[index];

  if (index == kept->size) {
    ++kept->size;
  }
  place->header.stamp = transform->header.stamp;
  static_tf_copy_text(&place->header.frame_id, &transform->header.frame_id);
  static_tf_copy_text(&place->child_frame_id, &transform->child_frame_id);
  place->transform = transform->transform;
}

rcl_ret_t rclc_static_tf_broadcaster_send(
  rclc_static_tf_broadcaster_t * broadcaster, const geometry_msgs__msg__TransformStamped * transforms,
  size_t count)
{
  rcl_ret_t result;

  if (broadcaster == NULL || !rcl_publisher_is_valid(&broadcaster->publisher)) {
    return microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "broadcaster");
  }
  result = rclc_tf_check(transforms, count);
  if (result == RCL_RET_OK) {
    result = static_tf_check(&broadcaster->message.transforms, transforms, count);
  }
  if (result == RCL_RET_OK) {
    const xrce_endpoint_t * const writer = broadcaster->publisher.impl->data;

    microros_lock();
    for (size_t i = 0; i < count; ++i) {
      static_tf_keep(&broadcaster->message.transforms, &transforms[i]);
    }
    broadcaster->is_due = true;
    xrce_session_pump(writer->client);
    microros_unlock();
  }
  return result;
}

/* Returns the data writer in the session of this client; NULL: none is open. */
static const xrce_endpoint_t * static_tf_writer(const xrce_client_t * client)
{
  const xrce_endpoint_t * writer;

  if (static_tf == NULL || !rmw_publisher_is_open(static_tf->publisher.impl)) {
    return NULL;
  }
  writer = static_tf->publisher.impl->data;
  return writer->client == client ? writer : NULL;
}

void rclc_static_tf_renew(const xrce_client_t * client)
{
  if (static_tf_writer(client) != NULL) {
    static_tf->is_due = static_tf->message.transforms.size != 0u;
  }
}

void rclc_static_tf_step(const xrce_client_t * client)
{
  const xrce_endpoint_t * const writer = static_tf_writer(client);
  cdr_fault_t fault; /* none: kept transforms are within the limits */
  uint8_t * room;
  size_t size;

  if (writer == NULL || !static_tf->is_due) {
    return;
  }
  room = xrce_write_reserve(writer);
  if (room == NULL) {
    return;
  }
  static_tf->is_due = false;
  size = (size_t)writer->type->encode(&static_tf->message, &room[STATIC_TF_BODY], &fault);
  xrce_put_submessage(
    room, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)((size_t)XRCE_OBJECT_PREFIX + size));
  xrce_put_be16(&room[4], XRCE_REQUEST_NONE);
  xrce_put_be16(&room[6], xrce_object_id(writer->index, XRCE_KIND_DATAWRITER));
  /* Cannot fail: a reliable stream keeps what it has until it is acknowledged. */
  (void)xrce_route_commit(writer->client, true, (size_t)STATIC_TF_BODY + size);
}
