/* SPDX-License-Identifier: Apache-2.0 */
#include "micro_ros_utilities/string_utilities.h"

#include "microros/message_pools.h"
#include "rosidl_runtime_c/string_functions.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static size_t utilities_length(const char * text)
{
  return text == NULL ? 0u : strlen(text);
}

/*
 * Ensures room for `size` bytes and the terminator, keeping the text. Returns false, with nothing changed,
 * on failure. */
static bool utilities_string_reserve(rosidl_runtime_c__String * str, size_t size)
{
  size_t room = size + 1u;
  char * data;

  if (str->data != NULL && size < str->capacity) {
    return true;
  }
  if (size == SIZE_MAX) {
    return false;
  }
  /*
   * Not reallocate: characters in static storage are not a block of the allocator, and only this function
   * knows their size. */
  data = microros_memory_take(MICROROS_POOL_text, &room);
  if (data == NULL) {
    return false;
  }
  if (str->data != NULL) {
    rosidl_runtime_c__String old = *str;

    (void)memcpy(data, old.data, old.size);
    rosidl_runtime_c__String__fini(&old);
  }
  str->data = data;
  str->capacity = room;
  return true;
}

rosidl_runtime_c__String micro_ros_string_utilities_init_with_size(const size_t size)
{
  rosidl_runtime_c__String str = {NULL, 0, 0};

  if (utilities_string_reserve(&str, size)) {
    (void)memset(str.data, 0, str.capacity);
  }
  return str;
}

rosidl_runtime_c__String micro_ros_string_utilities_init(const char * data)
{
  const rosidl_runtime_c__String empty = {NULL, 0, 0};

  return micro_ros_string_utilities_set(empty, data);
}

rosidl_runtime_c__String micro_ros_string_utilities_set(const rosidl_runtime_c__String str, const char * data)
{
  const rosidl_runtime_c__String empty = {str.data, 0, str.capacity};
  const rosidl_runtime_c__String set = micro_ros_string_utilities_append(empty, data);

  return set.size == utilities_length(data) ? set : str;
}

const char * micro_ros_string_utilities_get_c_str(const rosidl_runtime_c__String str)
{
  return str.data;
}

rosidl_runtime_c__String micro_ros_string_utilities_append(
  const rosidl_runtime_c__String str, const char * data)
{
  const size_t length = utilities_length(data);
  rosidl_runtime_c__String grown = str;

  if (length > SIZE_MAX - str.size || !utilities_string_reserve(&grown, str.size + length)) {
    return str;
  }
  if (length != 0u) {
    (void)memmove(&grown.data[grown.size], data, length);
  }
  grown.size += length;
  grown.data[grown.size] = '\0';
  return grown;
}

rosidl_runtime_c__String micro_ros_string_utilities_remove_tail_chars(
  const rosidl_runtime_c__String str, const size_t n)
{
  rosidl_runtime_c__String cut = str;

  if (cut.data != NULL) {
    cut.size -= n < cut.size ? n : cut.size;
    cut.data[cut.size] = '\0';
  }
  return cut;
}

void micro_ros_string_utilities_destroy(rosidl_runtime_c__String * const str)
{
  rosidl_runtime_c__String__fini(str);
}
