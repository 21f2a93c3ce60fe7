/* SPDX-License-Identifier: Apache-2.0 */
/* This project's side: what its handle points to. */
#include <microros/cdr_decode.h>

#include <stddef.h>

#include "codec.h"

uint32_t codec_encode(const rosidl_message_type_support_t * handle, const void * message)
{
  const microros_message_type_t * const type = (const microros_message_type_t *)handle->data;
  cdr_fault_t fault;
  return type->encode(message, codec_buffer, &fault);
}

bool codec_decode(const rosidl_message_type_support_t * handle, uint32_t size, void * message)
{
  const microros_message_type_t * const type = (const microros_message_type_t *)handle->data;
  cdr_fault_t fault;
  return cdr_decode(type, codec_buffer, size, false, message, &fault);
}

uint32_t codec_encode_again(const rosidl_message_type_support_t * handle, const void * message)
{
  return codec_encode(handle, message);
}

bool codec_decode_again(const rosidl_message_type_support_t * handle, uint32_t size, void * message)
{
  return codec_decode(handle, size, message);
}
