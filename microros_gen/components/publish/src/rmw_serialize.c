/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/message_type.h"
#include "microros/rmw_encode.h"
#include "rmw/rmw.h"

#include <stddef.h>
#include <string.h>

/* XCDR1, little endian, no options (OMG DDS-XTypes 1.3, 7.6.3.1.2). */
static const uint8_t encapsulation[] = {0, 1, 0, 0};

rmw_ret_t rmw_serialize(
  const void * ros_message, const rosidl_message_type_support_t * type_support,
  rmw_serialized_message_t * serialized_message)
{
  cdr_fault_t fault; /* set if the message is refused */
  const microros_message_type_t * type;
  size_t size;

  if (ros_message == NULL || type_support == NULL || serialized_message == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "ros_message, type_support or serialized_message");
  }
  type = type_support->data;
  size = (size_t)type->encoded_size(ros_message, &fault);
  if (size == 0u) {
    return rmw_encode_refuse(type, &fault);
  }
  size += sizeof(encapsulation);
  if (
    serialized_message->buffer_capacity < size &&
    rmw_serialized_message_resize(serialized_message, size) != RCUTILS_RET_OK) {
    return RMW_RET_BAD_ALLOC;
  }
  (void)memcpy(serialized_message->buffer, encapsulation, sizeof(encapsulation));
  if (type->encode(ros_message, &serialized_message->buffer[sizeof(encapsulation)], &fault) == 0u) {
    return rmw_encode_refuse(type, &fault);
  }
  serialized_message->buffer_length = size;
  return RMW_RET_OK;
}

rmw_ret_t rmw_uros_get_serialized_message_size(
  const void * ros_message, const rosidl_message_type_support_t * type_support, size_t * size)
{
  cdr_fault_t fault; /* set if the message is refused */
  const microros_message_type_t * type;
  uint32_t body;

  if (ros_message == NULL || type_support == NULL || size == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "ros_message, type_support or size");
  }
  type = type_support->data;
  body = type->encoded_size(ros_message, &fault);
  if (body == 0u) {
    return rmw_encode_refuse(type, &fault);
  }
  *size = sizeof(encapsulation) + (size_t)body;
  return RMW_RET_OK;
}

rmw_ret_t rmw_get_serialized_message_size(
  const rosidl_message_type_support_t * type_support,
  const rosidl_runtime_c__Sequence__bound * message_bounds, size_t * size)
{
  const microros_message_type_t * type;

  (void)message_bounds;
  if (type_support == NULL || size == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "type_support or size");
  }
  type = type_support->data;
  *size = sizeof(encapsulation) + (size_t)type->max_encoded_size;
  return RMW_RET_OK;
}
