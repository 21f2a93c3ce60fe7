/* SPDX-License-Identifier: Apache-2.0 */
#include "rosidl_runtime_c/u16string_functions.h"

#include "microros/message_pools.h"

#include <stdint.h>
#include <string.h>

static uint_least16_t * u16string_empty(void)
{
  static uint_least16_t nothing = 0; /* shared by all empty strings and threads, therefore never written */

  return &nothing;
}

bool rosidl_runtime_c__U16String__init(rosidl_runtime_c__U16String * str)
{
  if (str == NULL) {
    return false;
  }
  str->data = u16string_empty();
  str->size = 0;
  str->capacity = 1;
  return true;
}

static void u16string_release(rosidl_runtime_c__U16String * str)
{
  if (str->data != u16string_empty()) {
    microros_memory_give_back(MICROROS_POOL_u16text, str->data);
  }
}

void rosidl_runtime_c__U16String__fini(rosidl_runtime_c__U16String * str)
{
  if (str == NULL) {
    return;
  }
  u16string_release(str);
  str->data = NULL;
  str->size = 0;
  str->capacity = 0;
}

/* Ensures room for `size` units and the terminator; `keep` preserves the existing units. */
static bool u16string_make_room(rosidl_runtime_c__U16String * str, size_t size, bool keep)
{
  size_t room;
  uint_least16_t * data;

  if (str->data != NULL && str->capacity > size && (str->data != u16string_empty() || size == 0u)) {
    return true;
  }
  if (size >= SIZE_MAX / sizeof(uint_least16_t)) {
    return false;
  }
  room = (size + 1u) * sizeof(uint_least16_t);
  data = microros_memory_take(MICROROS_POOL_u16text, &room);
  if (data == NULL) {
    return false;
  }
  if (keep && str->data != NULL) {
    (void)memcpy(data, str->data, str->size * sizeof(uint_least16_t));
  }
  u16string_release(str);
  str->data = data;
  str->capacity = room / sizeof(uint_least16_t);
  return true;
}

bool rosidl_runtime_c__U16String__assignn_from_char(
  rosidl_runtime_c__U16String * str, const char * value, size_t n)
{
  if (str == NULL || value == NULL || !u16string_make_room(str, n, false)) {
    return false;
  }
  if (str->data != u16string_empty()) {
    (void)memmove(str->data, value, n * sizeof(uint_least16_t));
    str->data[n] = 0;
  }
  str->size = n;
  return true;
}

bool rosidl_runtime_c__U16String__assignn(rosidl_runtime_c__U16String * str, const uint16_t * value, size_t n)
{
  return rosidl_runtime_c__U16String__assignn_from_char(str, (const char *)value, n);
}

size_t rosidl_runtime_c__U16String__len(const uint16_t * value)
{
  size_t size = 0;

  while (value != NULL && value[size] != 0u) {
    ++size;
  }
  return size;
}

bool rosidl_runtime_c__U16String__assign(rosidl_runtime_c__U16String * str, const uint16_t * value)
{
  return rosidl_runtime_c__U16String__assignn(str, value, rosidl_runtime_c__U16String__len(value));
}

bool rosidl_runtime_c__U16String__copy(
  const rosidl_runtime_c__U16String * input, rosidl_runtime_c__U16String * output)
{
  return input != NULL && rosidl_runtime_c__U16String__assignn(output, input->data, input->size);
}

bool rosidl_runtime_c__U16String__resize(rosidl_runtime_c__U16String * str, size_t n)
{
  if (str == NULL || !u16string_make_room(str, n, true)) {
    return false;
  }
  if (str->data != u16string_empty()) {
    if (n > str->size) {
      (void)memset(&str->data[str->size], 0, (n - str->size) * sizeof(uint_least16_t));
    }
    str->data[n] = 0;
  }
  str->size = n;
  return true;
}

bool rosidl_runtime_c__U16String__are_equal(
  const rosidl_runtime_c__U16String * lhs, const rosidl_runtime_c__U16String * rhs)
{
  if (lhs == NULL || rhs == NULL || lhs->size != rhs->size) {
    return false;
  }
  return lhs->size == 0u || memcmp(lhs->data, rhs->data, lhs->size * sizeof(uint_least16_t)) == 0;
}
