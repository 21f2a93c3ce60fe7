/* SPDX-License-Identifier: Apache-2.0 */
#include "rosidl_runtime_c/string_functions.h"

#include "microros/message_pools.h"

#include <stdint.h>
#include <string.h>

static char * string_empty(void)
{
  static char nothing = 0; /* shared by all empty strings and threads, therefore never written */

  return &nothing;
}

bool rosidl_runtime_c__String__init(rosidl_runtime_c__String * str)
{
  if (str == NULL) {
    return false;
  }
  str->data = string_empty();
  str->size = 0;
  str->capacity = 1;
  return true;
}

static void string_release(rosidl_runtime_c__String * str)
{
  if (str->data != string_empty()) {
    microros_memory_give_back(MICROROS_POOL_text, str->data);
  }
}

void rosidl_runtime_c__String__fini(rosidl_runtime_c__String * str)
{
  if (str == NULL) {
    return;
  }
  string_release(str);
  str->data = NULL;
  str->size = 0;
  str->capacity = 0;
}

/* Ensures room for `size` units and the terminator. */
static bool string_make_room(rosidl_runtime_c__String * str, size_t size)
{
  size_t room = size + 1u;
  char * data;

  if (str->data != NULL && str->capacity > size && (str->data != string_empty() || size == 0u)) {
    return true;
  }
  if (size >= SIZE_MAX) {
    return false;
  }
  data = microros_memory_take(MICROROS_POOL_text, &room);
  if (data == NULL) {
    return false;
  }
  string_release(str);
  str->data = data;
  str->capacity = room;
  return true;
}

bool rosidl_runtime_c__String__assignn(rosidl_runtime_c__String * str, const char * value, size_t n)
{
  if (str == NULL || value == NULL || !string_make_room(str, n)) {
    return false;
  }
  if (str->data != string_empty()) {
    (void)memmove(str->data, value, n);
    str->data[n] = '\0';
  }
  str->size = n;
  return true;
}

bool rosidl_runtime_c__String__assign(rosidl_runtime_c__String * str, const char * value)
{
  return value != NULL && rosidl_runtime_c__String__assignn(str, value, strlen(value));
}

bool rosidl_runtime_c__String__copy(const rosidl_runtime_c__String * input, rosidl_runtime_c__String * output)
{
  return input != NULL && rosidl_runtime_c__String__assignn(output, input->data, input->size);
}

bool rosidl_runtime_c__String__are_equal(
  const rosidl_runtime_c__String * lhs, const rosidl_runtime_c__String * rhs)
{
  if (lhs == NULL || rhs == NULL || lhs->size != rhs->size) {
    return false;
  }
  return lhs->size == 0u || memcmp(lhs->data, rhs->data, lhs->size) == 0;
}
