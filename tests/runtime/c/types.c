/* SPDX-License-Identifier: Apache-2.0 */
#include "types.h"

#include "microros/message_type.h"

#include <string.h>

/* types_read.c has decoders. */
#ifndef INT32_DECODE
#define INT32_DECODE NULL
#define STRING_DECODE NULL
#endif

enum { STRING_LIMIT = 8 };

static void put_u32(uint8_t * at, uint32_t value)
{
  for (unsigned i = 0; i < 4u; ++i) {
    at[i] = (uint8_t)((value >> (8u * i)) & 0xffu);
  }
}

static uint32_t int32_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const std_msgs__msg__Int32 * int32 = message;

  (void)fault;
  put_u32(body, (uint32_t)int32->data);
  return 4;
}

static uint32_t int32_size(const void * message, cdr_fault_t * fault)
{
  (void)message;
  (void)fault;
  return 4;
}

static const microros_message_type_t int32_type = {
  "std_msgs::msg::dds_::Int32_", 4, int32_encode, int32_size, INT32_DECODE};
static const rosidl_message_type_support_t int32_support = {"microros", &int32_type};

const rosidl_message_type_support_t *
rosidl_typesupport_c__get_message_type_support_handle__std_msgs__msg__Int32(void)
{
  return &int32_support;
}

static uint32_t string_size(const void * message, cdr_fault_t * fault)
{
  const std_msgs__msg__String * string = message;

  if (string->data.size > STRING_LIMIT) {
    fault->field = "data";
    fault->within = NULL;
    fault->kind = CDR_FAULT_LIMIT;
    fault->found = (uint32_t)string->data.size;
    fault->fits = STRING_LIMIT;
    return 0;
  }
  return (uint32_t)string->data.size + 5u;
}

static uint32_t string_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const std_msgs__msg__String * string = message;
  const uint32_t size = string_size(message, fault);

  if (size != 0u) {
    put_u32(body, size - 4u);
    memcpy(&body[4], string->data.data, string->data.size);
    body[size - 1u] = 0;
  }
  return size;
}

static const microros_message_type_t string_type = {
  "std_msgs::msg::dds_::String_", STRING_LIMIT + 5, string_encode, string_size, STRING_DECODE};
static const rosidl_message_type_support_t string_support = {"microros", &string_type};

const rosidl_message_type_support_t *
rosidl_typesupport_c__get_message_type_support_handle__std_msgs__msg__String(void)
{
  return &string_support;
}
