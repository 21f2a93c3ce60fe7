/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/message_type.h"
#include "microros/rmw_decode.h"
#include "rmw/rmw.h"

#include <stddef.h>

/* Representation identifier and options; CDR_BE and CDR_LE are 0 and 1 (OMG DDS-XTypes 1.3, 7.6.3.1.2). */
enum { ENCAPSULATION_SIZE = 4, CDR_LITTLE_ENDIAN = 1 };

rmw_ret_t rmw_deserialize(
  const rmw_serialized_message_t * serialized_message, const rosidl_message_type_support_t * type_support,
  void * ros_message)
{
  const microros_message_type_t * type;
  const uint8_t * bytes;
  uint32_t representation;
  size_t size;

  if (serialized_message == NULL || type_support == NULL || ros_message == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "serialized_message, type_support or ros_message");
  }
  type = type_support->data;
  if (type->decode == NULL) {
    return microros_error_named(RMW_RET_UNSUPPORTED, microros_error_not_received, type->dds_type_name);
  }
  bytes = serialized_message->buffer;
  size = (bytes == NULL) ? 0u : serialized_message->buffer_length;
  if (size < (size_t)ENCAPSULATION_SIZE) {
    const cdr_fault_t short_of = {
      .field = "encapsulation",
      .within = NULL,
      .found = ENCAPSULATION_SIZE,
      .fits = (uint32_t)size,
      .index = CDR_NO_INDEX,
      .kind = CDR_FAULT_END,
      .depth = 0};

    return rmw_decode_refuse(type, &short_of);
  }
  representation = ((uint32_t)bytes[0] << 8) | bytes[1];
  if (representation > (uint32_t)CDR_LITTLE_ENDIAN) {
    microros_error_set(
      microros_error_encapsulation, type->dds_type_name, NULL, representation, CDR_LITTLE_ENDIAN);
    return RMW_RET_ERROR;
  }
  bytes = &bytes[ENCAPSULATION_SIZE];
  size -= (size_t)ENCAPSULATION_SIZE;
  size = (size > UINT32_MAX) ? UINT32_MAX : size;
  return rmw_decode(type, bytes, (uint32_t)size, representation != (uint32_t)CDR_LITTLE_ENDIAN, ros_message);
}
