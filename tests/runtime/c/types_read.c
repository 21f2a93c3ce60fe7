/* SPDX-License-Identifier: Apache-2.0 */
/* The types of types.c, with decoders. */
#include "types.h"

#include "microros/cdr_decode.h"

#include <string.h>

static uint32_t get_u32(const uint8_t * at, bool big_endian)
{
  uint32_t value = 0;

  for (unsigned i = 0; i < 4u; ++i) {
    value |= (uint32_t)at[i] << (8u * (big_endian ? 3u - i : i));
  }
  return value;
}

static void fail(cdr_in_t * in, cdr_fault_kind_t kind, uint32_t found, uint32_t fits)
{
  in->failed = true;
  in->fault->field = "data";
  in->fault->within = NULL;
  in->fault->kind = kind;
  in->fault->found = found;
  in->fault->fits = fits;
  in->fault->index = CDR_NO_INDEX;
  in->fault->depth = 0;
}

static bool is_big_endian(const cdr_in_t * in)
{
  const uint16_t one = 1;

  return in->swap != (*(const uint8_t *)&one == 0u);
}

static void int32_decode(cdr_in_t * in, void * message)
{
  std_msgs__msg__Int32 * int32 = message;

  if (in->size < 4u) {
    fail(in, CDR_FAULT_END, 4, in->size);
  } else {
    int32->data = (int32_t)get_u32(in->body, is_big_endian(in));
  }
}

static void string_decode(cdr_in_t * in, void * message)
{
  std_msgs__msg__String * string = message;
  const uint32_t length = in->size < 4u ? 0u : get_u32(in->body, is_big_endian(in));

  if (in->size < 5u || length == 0u || length > in->size - 4u) {
    fail(in, CDR_FAULT_END, length, in->size);
  } else if (length > string->data.capacity) {
    fail(in, CDR_FAULT_CAPACITY, length - 1u, (uint32_t)string->data.capacity - 1u);
  } else {
    memcpy(string->data.data, &in->body[4], length);
    string->data.size = length - 1u;
  }
}

#define INT32_DECODE int32_decode
#define STRING_DECODE string_decode
#include "types.c" /* NOLINT */
